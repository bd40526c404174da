"""Writes networks/drive_cycle.csv: the speed of a shaft over 30 minutes, once a second.

A cycle of its own, after no standard: eight starts and stops in a town, then a faster stretch with two
stops. Each stretch runs up, holds, and runs down along straight lines; a slow ripple lies over what is held.

    python3 tools/drive_cycle.py > networks/drive_cycle.csv
"""

from math import pi, sin

# seconds of standing, running up, holding and running down, and the speed held in rpm
TOWN = [(20, 15, 40, 10, 2500), (15, 20, 55, 15, 3500), (10, 12, 25, 8, 2000), (25, 25, 60, 20, 4200)]
ROAD = [(20, 40, 330, 30, 6500), (10, 45, 440, 45, 7000)]
STRETCHES = TOWN + TOWN + ROAD
SECONDS = 1800


def speed(second: int) -> float:
    for stand, up, hold, down, held in STRETCHES:
        if second < stand + up + hold + down:
            ramp = min((second - stand) / up, (stand + up + hold + down - second) / down, 1.0)
            ripple = 1.0 + 0.04 * sin(2 * pi * second / 37) if ramp == 1.0 else 1.0
            return max(held * ramp * ripple, 0.0)
        second -= stand + up + hold + down
    return 0.0


print("t [s],speed [rpm]")
for second in range(SECONDS + 1):
    print(f"{second},{speed(second):.0f}")
