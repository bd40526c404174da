#!/usr/bin/env python3
"""Writes the properties of fluids over temperature, which films of the library take, and points
between them for the test.

    pip install CoolProp
    python3 tools/properties.py

Needs CoolProp (https://coolprop.org, MIT licence), whose equations it tabulates:
air: E. W. Lemmon et al., J. Phys. Chem. Ref. Data 29 (2000) 331; E. W. Lemmon and R. T. Jacobsen,
Int. J. Thermophys. 25 (2004) 21. Water: W. Wagner and A. Pruss (IAPWS-95), J. Phys. Chem. Ref. Data
31 (2002) 387; M. L. Huber et al., 38 (2009) 101 and 41 (2012) 033102. Glycol: A. Melinder,
Properties of Secondary Working Fluids (IIR 2010). R134a: R. Tillner-Roth and H. D. Baehr,
J. Phys. Chem. Ref. Data 23 (1994) 657. R1234yf: M. Richter, M. O. McLinden and E. W. Lemmon,
J. Chem. Eng. Data 56 (2011) 3254.

Carbon steel over temperature is that of EN 1993-1-2:2005, 3.4.1; copper, aluminium and silicon are
those of F. P. Incropera et al., Fundamentals of Heat and Mass Transfer, 7th ed., Table A.1.
"""

from pathlib import Path

import CoolProp
from CoolProp.CoolProp import PropsSI

ROOT = Path(__file__).resolve().parent.parent / "crates/lptn-netlist"
ATMOSPHERE = 101_325.0

# key, letter of CoolProp, unit
PROPERTIES = [
    ("density", "D", "kg/m^3"),
    ("cp", "C", "J/(kg K)"),
    ("k", "L", "W/(m K)"),
    ("viscosity", "V", "Pa s"),
    ("expansion", "isobaric_expansion_coefficient", "1/K"),
]


def steps(*parts):
    """Temperatures in K: from, to (left out), step; the last end is kept."""
    points = [t for low, high, step in parts for t in range(low, high, step)]
    return [float(t) for t in points] + [float(parts[-1][1])]


def gas(letter, t):
    return PropsSI(letter, "T", t, "P", ATMOSPHERE, "Air")


def boiling(letter, t):
    return PropsSI(letter, "T", t, "Q", 0, "Water")


def brine(letter, t):
    """CoolProp has no expansion of an incompressible fluid; it follows from the density."""
    at = lambda letter, t: PropsSI(letter, "T", t, "P", ATMOSPHERE, "INCOMP::MEG[0.5]")
    if letter != "isobaric_expansion_coefficient":
        return at(letter, t)
    return -(at("D", t + 0.5) - at("D", t - 0.5)) / at("D", t)


def liquid(fluid):
    return lambda letter, t: PropsSI(letter, "T", t, "Q", 0, fluid)


# name, function, temperatures, least temperature of the expansion, what it is
FLUIDS = [
    ("air", gas, steps((150, 500, 10), (500, 800, 25), (800, 1500, 50)), 0.0,
     "dry air at 101325 Pa"),
    ("water", boiling, [273.16, *steps((274, 314, 2), (314, 574, 5))], 280.0,
     "liquid water that is about to boil; its expansion from 280 K on, which is above its largest "
     "density"),
    ("glycol_50", brine, steps((245, 335, 2), (335, 370, 5)), 0.0,
     "ethylene glycol in water, 50 % of the mass, at 101325 Pa"),
    ("r134a", liquid("R134a"), steps((220, 320, 4), (320, 350, 2)), 0.0,
     "liquid R134a that is about to boil"),
    ("r1234yf", liquid("R1234yf"), steps((224, 312, 4), (312, 344, 2)), 0.0,
     "liquid R1234yf that is about to boil"),
]


def steel_cp(t):
    """EN 1993-1-2, 3.4.1.2, of carbon steel; t in K."""
    c = t - 273.15
    if c < 600:
        return 425 + 0.773 * c - 1.69e-3 * c**2 + 2.22e-6 * c**3
    if c < 735:
        return 666 + 13002 / (738 - c)
    return max(545 + 17820 / (c - 731), 650)


def steel_k(t):
    """EN 1993-1-2, 3.4.1.3."""
    c = t - 273.15
    return 54 - 3.33e-2 * c if c < 800 else 27.3


def steel_points():
    """Denser around the peak of cp at 735 degC and where its formula changes."""
    rising = [738 - 138 * (3.02 / 138) ** (i / 60) for i in range(61)]
    falling = [731 + 4.02 * (169 / 4.02) ** (i / 60) for i in range(60)]
    falling = [c for c in falling if c < 885] + [887, 893, 897, 899, 900]
    celsius = [*range(20, 600, 20), 590, 597, 599.5, *rising, 735, *falling, *range(920, 1201, 40)]
    return [273.15 + c for c in celsius]


# k is linear, with a step at 800 degC
STEEL_K_POINTS = [273.15 + c for c in (20, 799.9, 800, 1200)]

# Incropera et al., 7th ed., Table A.1: T in K, k in W/(m K), cp in J/(kg K); rows at 300 K are its
# first columns
METALS = {
    "copper_incropera": (
        [100, 200, 300, 400, 600, 800, 1000, 1200],
        [482, 413, 401, 393, 379, 366, 352, 339],
        [252, 356, 385, 397, 417, 433, 451, 480]),
    "aluminium_incropera": (
        [100, 200, 300, 400, 600, 800],
        [302, 237, 237, 240, 231, 218],
        [482, 798, 903, 949, 1033, 1146]),
    "silicon_incropera": (
        [200, 300, 400, 600, 800, 1000, 1200, 1500],
        [264, 148, 98.9, 61.9, 42.2, 31.2, 25.7, 22.7],
        [556, 712, 790, 867, 913, 946, 967, 992]),
}


def tabulated(temperatures, values):
    """A property that is known at these temperatures only, with its temperatures."""
    return dict(zip(temperatures, values)).__getitem__, temperatures, "pchip"


# name, properties with their functions, temperatures and interpolation, source
SOLIDS = [
    ("steel_en_1993",
     {"cp": (steel_cp, steel_points(), "pchip"), "k": (steel_k, STEEL_K_POINTS, "linear")},
     "EN 1993-1-2:2005, 3.4.1"),
    *((name, {"cp": tabulated(t, cp), "k": tabulated(t, k)}, "Incropera et al., 7th ed., Table A.1")
      for name, (t, k, cp) in METALS.items()),
]


def number(value):
    return f"{value:.7g}"


def films():
    lines = [
        "# Properties of fluids over temperature, for films. Generated by tools/properties.py with",
        f"# CoolProp {CoolProp.__version__}; the sources are named there. Do not edit.",
    ]
    for name, at, temperatures, least, title in FLUIDS:
        lines += ["", f"[fluid.{name}]", f'source = "CoolProp {CoolProp.__version__}: {title}"']
        for key, letter, unit in PROPERTIES:
            own = [t for t in temperatures if key != "expansion" or t >= least]
            x = ", ".join(number(t) for t in own)
            y = ", ".join(number(at(letter, t)) for t in own)
            lines.append(f'{key} = {{ x = [{x}], x_unit = "K", y = [{y}], y_unit = "{unit}", interp = "pchip" }}')
    units = {key: unit for key, _, unit in PROPERTIES}
    for name, properties, source in SOLIDS:
        lines += ["", f"[material.{name}]", f'source = "{source}"']
        for key, (at, temperatures, interp) in properties.items():
            x = ", ".join(number(t) for t in temperatures)
            y = ", ".join(number(at(t)) for t in temperatures)
            lines.append(f'{key} = {{ x = [{x}], x_unit = "K", y = [{y}], y_unit = "{units[key]}", interp = "{interp}" }}')
    return "\n".join(lines) + "\n"


def between():
    """Two fifths of the way between neighbours."""
    keys = ",".join(key for key, _, _ in PROPERTIES)
    lines = [f"# CoolProp {CoolProp.__version__}, by tools/properties.py; SI units", f"fluid,T,{keys}"]
    for name, at, temperatures, least, _ in FLUIDS:
        for low, high in zip(temperatures, temperatures[1:]):
            t = low + 0.4 * (high - low)
            known = [letter for _, letter, _ in PROPERTIES if len(letter) == 1 or low >= least]
            cells = [number(at(letter, t)) for letter in known]
            lines.append(",".join([name, number(t), *cells]))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    (ROOT / "src/films.toml").write_text(films())
    (ROOT / "tests/films.csv").write_text(between())
