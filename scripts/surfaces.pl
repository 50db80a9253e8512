#!/usr/bin/perl
# Makes surfaces/ridged_plate.gsf: a polished plate with machined ridges, 25 mm at 10 um. Ridges of 0.8 mm pitch, 0.32 mm wide and 30 um high
# (a raised cosine), flat valleys between, and a grain of 2 nm rms from a fixed linear congruential generator: what is left after polishing is
# well below the limiter, so that only the ridges press. Invented geometry, not a measurement.
# Usage: perl scripts/surfaces.pl > surfaces/ridged_plate.gsf
use strict;
use warnings;
my ($n, $h, $pi, $state) = (2500, 10e-6, 4 * atan2(1, 1), 1);
my @z;
for my $i (0 .. $n - 1) {
    my $x = $i * $h;
    my $across = ($x / 0.8e-3 - int($x / 0.8e-3)) / 0.4;
    $state = ($state * 69069 + 1234567) % 2**32;
    my $grain = ($state / 2**32 - 0.5) * sqrt(12) * 2e-9;
    push @z, ($across < 1 ? 15e-6 * (1 - cos(2 * $pi * $across)) : 0) + $grain;
}
my $mean = 0;
$mean += $_ / $n for @z;
my $head = sprintf "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = 1\nXReal = %.9g\nYReal = %.9g\nXYUnits = m\nZUnits = m\nTitle = ridged plate\n",
    $n, $n * $h, $h;
binmode STDOUT;
print $head, "\0" x (4 - length($head) % 4), pack('f<*', map { $_ - $mean } @z);
