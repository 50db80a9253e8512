#!/usr/bin/perl
# Makes surfaces/ridged_plate.gsf: a plate with machined ridges, 25 mm at 10 um. Ridges of 0.8 mm pitch and 30 um height with rounded
# tops (a sine to the power 0.6 is the ridge, valleys are flat), tool marks of 0.11 mm and 1.5 um along them, and a grain of 0.8 um rms
# from a fixed linear congruential generator. Invented geometry, not a measurement. Usage: perl scripts/surfaces.pl > surfaces/ridged_plate.gsf
use strict;
use warnings;
my ($n, $h, $pi, $state) = (2500, 10e-6, 4 * atan2(1, 1), 1);
my @z;
for my $i (0 .. $n - 1) {
    my $x = $i * $h;
    my $ridge = sin(2 * $pi * $x / 0.8e-3);
    $state = ($state * 69069 + 1234567) % 2**32;
    my $grain = ($state / 2**32 - 0.5) * sqrt(12) * 0.8e-6;
    push @z, 30e-6 * ($ridge > 0 ? $ridge**0.6 : 0) + 1.5e-6 * sin(2 * $pi * $x / 0.11e-3) + $grain;
}
my $mean = 0;
$mean += $_ / $n for @z;
my $head = sprintf "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = 1\nXReal = %.9g\nYReal = %.9g\nXYUnits = m\nZUnits = m\nTitle = ridged plate\n",
    $n, $n * $h, $h;
binmode STDOUT;
print $head, "\0" x (4 - length($head) % 4), pack('f<*', map { $_ - $mean } @z);
