# Mode tables of simple objects from closed forms (POSIX awk; called by scripts/irs.sh).
#
# Velocity at the listening point per N s at the place, for unit modal mass: x'' + 2 sigma x' + omega_0^2 x = phi(place) f,
#     v(t) = phi(place) phi(listener) e^(-sigma t) (cos omega t - (sigma/omega) sin omega t)
#          = gain e^(-sigma t) sin(omega t + phase),
#     sigma = eta omega_0 / 2, omega = sqrt(omega_0^2 - sigma^2),
#     gain = phi(place) phi(listener) omega_0/omega, phase = atan2(1, -sigma/omega).
#
# plate: thin, specially orthotropic (grain along x), simply supported (Leissa, Vibration of Plates, NASA SP-160, 1969):
#     omega_mn^2 = pi^4 / (rho h) (Dx (m/a)^4 + 2 H (m/a)^2 (n/b)^2 + Dy (n/b)^4),  phi = 2/sqrt(rho h a b) sin(m pi x/a) sin(n pi y/b)
#     Dx = E h^3 / (12 (1 - nu^2 Ey/E)), Dy = Dx Ey/E, H = Dx nu Ey/E + 2 G h^3/12
# bar:   Euler-Bernoulli, free at both ends, round, struck and heard at its end:
#     omega_k = lambda_k^2/l^2 sqrt(E I/(rho A)), cosh(lambda) cos(lambda) = 1, sqrt(I/A) = d/4,  phi(end) = 2/sqrt(mass)
#
# Numbers are printed with 12 digits, so that the last bits of a C library's sin do not show.

function tanh_half_root(lambda,    e) { # of cos(lambda) cosh(lambda) - 1, divided by cosh: bounded
    e = exp(-lambda)
    return cos(lambda) - 2 * e / (1 + e * e)
}

function lambda_of(k,    low, high, middle, sign, i) {
    low = k * pi
    high = (k + 1) * pi
    sign = tanh_half_root(low) < 0 ? -1 : 1
    for (i = 0; i < 60; i++) {
        middle = (low + high) / 2
        if (tanh_half_root(middle) * sign > 0) low = middle
        else high = middle
    }
    return (low + high) / 2
}

# sin(pi p/q), exact zeros and symmetries.
function sine(p, q,    sign) {
    sign = 1
    p = p % (2 * q)
    if (p > q) { p = p - q; sign = -1 }
    if (2 * p > q) p = q - p
    return p == 0 ? 0 : sign * sin(pi * p / q)
}

# Adds a mode: omega_0 and what tells its shape.
function add(omega, m, n,    i) {
    for (i = ++modes; i > 1 && w[i - 1] > omega; i--) {
        w[i] = w[i - 1]; shape_m[i] = shape_m[i - 1]; shape_n[i] = shape_n[i - 1]
    }
    w[i] = omega; shape_m[i] = m; shape_n[i] = n
}

function row(place, x, y, k, phi2,    sigma, omega) {
    sigma = eta * w[k] / 2
    omega = sqrt(w[k] * w[k] - sigma * sigma)
    printf "%d,%.12g,%.12g,%d,%.12g,%.12g,%.12g,%.12g\n", place, x, y, k, omega / (2 * pi), sigma, phi2 * w[k] / omega,
        atan2(1, -sigma / omega)
}

function header(what) {
    print "# poles: shared"
    print "# quantity: velocity"
    print "# normalisation: (m/s)/(N s), physical; " what
    print "# object: " object
    print "# source: " source
    print "# holds: " holds
    print "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad"
}

function plate(    dx, dy, twist, m, n, i, k, mass, unit) {
    dx = E * h * h * h / (12 * (1 - nu * nu * ratio))
    dy = dx * ratio
    twist = dx * nu * ratio + 2 * G * h * h * h / 12
    mass = rho * h * a * b
    for (m = 1; m < 100; m++)
        for (n = 1; n < 100; n++) {
            unit = dx * (m / a) ^ 4 + 2 * twist * (m / a) ^ 2 * (n / b) ^ 2 + dy * (n / b) ^ 4
            unit = pi * pi * sqrt(unit / (rho * h))
            if (unit < 2 * pi * highest) add(unit, m, n)
        }
    header(sprintf("heard at x = %.12g m, y = %.12g m", listen_x, listen_y))
    for (i = 0; i <= steps; i++)
        for (k = 1; k <= modes; k++)
            row(i + 1, a * i / steps, y, k, 4 / mass * sine(shape_m[k] * i, steps) * sin(pi * shape_n[k] * y / b) \
                * sin(pi * shape_m[k] * listen_x / a) * sin(pi * shape_n[k] * listen_y / b))
}

function bar(    mass, k, lambda, omega) {
    mass = rho * pi * d * d / 4 * l
    for (k = 1; k < 1000; k++) {
        lambda = lambda_of(k)
        omega = lambda * lambda / (l * l) * sqrt(E / rho) * d / 4
        if (omega >= 2 * pi * highest) break
        add(omega, k, 0)
    }
    header("struck and heard at its end, across its length; as a whole it does not move")
    for (k = 1; k <= modes; k++)
        row(1, 0, 0, k, 4 / mass)
}

BEGIN {
    pi = atan2(0, -1)
    highest = 20000
    if (kind == "plate") plate()
    else bar()
}
