"""How the paper's words are read as numbers, the same for every claim."""

# "About", "nearly", "just under", "similar", "minor", "constant": within ten per cent, which is what a point read
# off a printed figure is worth.
ABOUT = 0.10
# "Only about 20 %", "weak", "little": what rounds to 20 % in steps of ten.
WEAK = 0.25
# "Zero": below one per cent of the usual value.
ZERO = 0.01
# "Small but not zero": more than that, and below a quarter of the usual value.
SMALL = 0.25
# "At small μ": up to here.
SMALL_FRICTION = 0.05
# "Abruptly": within a tenth of the coefficient of friction, from a tenth of the usual circulation to half of it.
ABRUPT = 0.10
STILL, CIRCULATING = 0.1, 0.5
# "Carried round the rim as if centrifuging": along the rim for most of the time, and most of the load over the top
# in a turn of the drum.
CENTRIFUGING = 0.5
# "Little relative motion": slower, relative to the turning drum, than a tenth of the rim.
LITTLE_MOTION = 0.1
