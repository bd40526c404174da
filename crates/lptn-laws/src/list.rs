//! The one list of kinds and laws. A new one is its file and its word here; everything else follows
//! from the declarations in the file.

use lptn_units::Scalar;

use crate::declare::{KindDeclaration, Law, LawDeclaration, ResultDeclaration};

macro_rules! declare {
    ($($module:ident: $($kind:ident)? { $($law:ident),* };)*) => {
        /// A kind of path or of source of heat: its section of the netlist, in the order of the
        /// columns; paths come first.
        #[allow(missing_docs, reason = "its declaration says what it is")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Kind { $($($kind,)?)* }

        impl Kind {
            /// All of them.
            pub const ALL: &[Self] = &[$($(Self::$kind,)?)*];

            /// Its declaration.
            pub const fn declaration(self) -> &'static KindDeclaration {
                match self { $($(Self::$kind => &crate::$module::$kind,)?)* }
            }
        }

        /// A law by which a path carries heat, or a source puts it into nodes.
        #[allow(missing_docs, reason = "its declaration says what it is")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Formula { $($($law,)*)* }

        impl Formula {
            /// All of them.
            pub const ALL: &[Self] = &[$($(Self::$law,)*)*];

            /// Its declaration.
            pub const fn declaration(self) -> &'static LawDeclaration {
                match self { $($(Self::$law => &<crate::$module::$law as Law>::DECLARATION,)*)* }
            }

            /// Its value, as [`Law::value`].
            #[inline]
            pub fn value<S: Scalar>(self, values: &[S], ends: [S; 2]) -> S {
                match self {
                    $($(Self::$law => <crate::$module::$law as Law>::value(values, ends),)*)*
                }
            }

            /// Its results in addition to its heat.
            pub const fn result_declarations(self) -> &'static [ResultDeclaration] {
                match self { $($(Self::$law => <crate::$module::$law as Law>::RESULTS,)*)* }
            }

            /// The capacity rate of the stream whose outlet `from` is, as [`Law::OUTLET`].
            pub const fn outlet(self) -> Option<&'static str> {
                match self { $($(Self::$law => <crate::$module::$law as Law>::OUTLET,)*)* }
            }

            /// Its results, as [`Law::results`].
            pub fn results(self, values: &[f64], ends: [f64; 2]) -> Vec<f64> {
                match self {
                    $($(Self::$law => <crate::$module::$law as Law>::results(values, ends),)*)*
                }
            }

            /// True if its results judge anything, as [`Law::judges`].
            pub fn judges(self, values: &[f64], ends: [f64; 2]) -> bool {
                match self {
                    $($(Self::$law => <crate::$module::$law as Law>::judges(values, ends),)*)*
                }
            }

            /// The values of its groups, as [`Law::groups`].
            pub fn groups(self, values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
                match self {
                    $($(Self::$law => <crate::$module::$law as Law>::groups(values, ends),)*)*
                }
            }
        }
    };
}

declare! {
    resistor: Resistor { Resistance, Conductance };
    conduction: Conduction { Slab, Cylinder, Sphere, Rod };
    convection: Convection { Film };
    free_convection: { VerticalPlate, HorizontalCylinder, UpperSide, LowerSide };
    forced_convection: { CrossFlow, CrossFlowHilpert, FlatPlate, Square, SquareOnEdge, Duct };
    rotation: { Shaft, Annulus };
    bodies: { SphereAtRest, SphereInFlow, InclinedPlate, Disc, Jet };
    gap: { GapFromBelow, GapVertical };
    fins: { StraightFins };
    plate_fins: { PlateFins, PlateFinsBlown };
    wall: { WallInWind, WallInVerticalFlow, GearboxWall, GearboxWallBlown };
    contact: Contact {};
    joint: { Joint };
    press_fit: PressFit { Interference };
    radiation: Radiation { ExchangeArea, GreySurfaces, ParallelPlates };
    cooler: Cooler {
        Counterflow, CounterflowOutlet, Parallel, ParallelOutlet, Crossflow, CrossflowOutlet,
        Shell, ShellOutlet, OneStream, OneStreamOutlet
    };
    advection: Advection { CapacityRate, MassFlow, VolumeFlow };
    source: Source { Given };
    bearing: Bearing { BearingNoLoad, BearingLoad };
    skf: { BearingSkf };
    seal: Seal { SealShaft, SealFkm, SealNbr };
    mesh: Mesh { MeshExternal, MeshInternal };
    scuffing: { MeshExternalScuffing, MeshInternalScuffing };
    churning: Churning { ChurnedCylinder, ChurnedSides, ChurnedTeeth };
}
