//! Published formulas of heat transfer and of losses, one function each, and the declarations of
//! laws and of kinds of paths and sources ([`Formula`], [`Kind`]): fields with quantity, range,
//! default and example, forms, validity, source. Netlist keys, checks, help, documents, expansion
//! and the tests of derivatives use these declarations.
//!
//! Every law is generic over [`Scalar`](lptn_units::Scalar): on `f64` it gives the value, on
//! [`Dual`](lptn_units::Dual) also the derivatives, from the same lines. All quantities are in SI
//! units, absolute temperatures in K. A function checks nothing: its description gives its valid
//! range, and the caller refuses values outside, with the name of the element. Inside the range,
//! value and derivatives are finite, also at `dT = 0`, at zero flow and at reversal.
//!
//! Links are written as q = G dT if a conductance exists, so that heat is never the small
//! difference of two large numbers.
//!
//! ```
//! use lptn_laws::{
//!     effective_emissivity_parallel_plates, radiation_conductance, radiation_exchange_area,
//! };
//! use lptn_units::Dual;
//!
//! let emissivity = effective_emissivity_parallel_plates(0.8, 0.9);
//! let gr = radiation_exchange_area(emissivity, 0.25, 1.0); // m^2
//!
//! // Heat from a plate of 350 K to one of 300 K, in W, and how it changes with either temperature,
//! // in W/K.
//! let (t_from, t_to) = (Dual::<2>::variable(350.0, 0), Dual::<2>::variable(300.0, 1));
//! let heat = radiation_conductance(Dual::constant(gr), t_from, t_to) * (t_from - t_to);
//! assert!((heat.value - 5.670374419e-8 * gr * (350f64.powi(4) - 300f64.powi(4))).abs() < 1e-12);
//! assert!((heat.derivatives[0] - 4.0 * 5.670374419e-8 * gr * 350f64.powi(3)).abs() < 1e-14);
//! ```

mod advection;
mod bearing;
mod bodies;
mod churning;
mod conduction;
mod contact;
mod convection;
mod cooler;
mod declare;
mod exchanger;
mod fan;
mod fins;
mod fluid;
mod forced_convection;
mod free_convection;
mod gap;
mod involute;
mod joint;
mod list;
mod lookup;
mod loss;
mod lump;
mod mesh;
mod phase;
mod plate_fins;
mod press_fit;
mod radiation;
mod range;
mod resistor;
mod rotation;
mod scuffing;
mod seal;
mod skf;
mod source;
mod viscosity_index;
mod wall;

pub use advection::{advection_from, advection_to, stream_from, stream_to};
pub use bearing::{bearing_load, bearing_no_load};
pub use bodies::{nusselt_disc, nusselt_jet, nusselt_sphere_at_rest, nusselt_sphere_in_flow};
pub use churning::Churned;
pub use conduction::{cylinder, rod, slab, sphere};
pub use convection::film;
pub use declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Group, Hints, KindDeclaration, Law,
    LawDeclaration, Range, ResultDeclaration, Substance, SurfaceKind,
};
pub use exchanger::{
    effectiveness_counterflow, effectiveness_crossflow, effectiveness_one_stream,
    effectiveness_parallel, effectiveness_shell,
};
pub use fan::fan_duty;
pub use fins::{fin_efficiency, finned};
pub use fluid::Fluid;
pub use forced_convection::{
    nusselt_cross_flow, nusselt_cross_flow_hilpert, nusselt_duct, nusselt_flat_plate,
    nusselt_flat_plate_from, nusselt_square, nusselt_square_on_edge,
};
pub use free_convection::{
    nusselt_horizontal_cylinder, nusselt_plate_driven, nusselt_plate_layered,
    nusselt_vertical_plate, rayleigh,
};
pub use gap::{nusselt_gap_from_below, nusselt_gap_vertical};
pub use involute::{Engagement, GearPair, Profile};
pub use joint::contact_conductance;
pub use list::{Formula, Kind};
pub use loss::THIN_OIL;
pub use lump::{biot, diffusion_time};
pub use mesh::{gear_loss_factor, mesh_friction};
pub use phase::melting_capacity;
pub use plate_fins::{nusselt_between_plates, nusselt_through_plates};
pub use press_fit::Fit;
pub use radiation::{
    STEFAN_BOLTZMANN, effective_emissivity_parallel_plates, radiation_conductance,
    radiation_exchange_area,
};
pub use rotation::{nusselt_annulus, nusselt_shaft};
pub use scuffing::Flanks;
pub use seal::{lip_seal, shaft_seal};
pub use skf::SkfBearing;
pub use viscosity_index::viscosity_at_100;
pub use wall::{along, combined, gearbox_wall, gearbox_wall_blown};
