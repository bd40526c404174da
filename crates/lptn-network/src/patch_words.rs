//! Words of build errors for patches of faces.

use lptn_units::format_short;

use crate::error_words::Say;
use crate::id::Field;
use crate::parts::patch::PatchProblem;

/// The field that is wrong if a patch has no cells.
pub(crate) fn patch_field(problem: &PatchProblem) -> Field {
    match problem {
        PatchProblem::Outside { .. } | PatchProblem::NotADisc => Field::Centre,
        PatchProblem::CurvedFace => Field::Radius,
        PatchProblem::Moved | PatchProblem::Unknown => Field::Name,
    }
}

/// A place along an axis in mm or deg.
fn along_axis(value: f64, axis: &str) -> String {
    match axis {
        "phi" => format!("{} deg", format_short(value.to_degrees())),
        _ => format!("{} mm", format_short(value * 1e3)),
    }
}

/// The reason why a patch has no cells.
pub(crate) fn not_on_face(say: &Say<'_>, problem: &PatchProblem, axes: &[&str; 2]) -> String {
    let name = say.name;
    match problem {
        PatchProblem::Outside { along, ends, face } => {
            let axis = axes[*along];
            let [low, high, start, end] =
                [ends[0], ends[1], face[0], face[1]].map(|value| along_axis(value, axis));
            format!(
                "`{name}` lies from {low} to {high} along {axis}, and its face from {start} to {end}"
            )
        }
        PatchProblem::CurvedFace => format!("`{name}` is a circle on a curved face"),
        PatchProblem::NotADisc => {
            format!("`{name}` is a circle on the end of a cylinder, but not a disc around its axis")
        }
        PatchProblem::Moved => {
            format!("`{name}` covers other cells of its face for these parameters")
        }
        PatchProblem::Unknown => format!("`{name}` has no place"),
    }
}

/// Help for a patch that has no cells.
pub(crate) fn other_patch(problem: &PatchProblem, axes: &[&str; 2]) -> String {
    let rectangle = |sample: &str| {
        format!("give a rectangle along {} and {} instead: `size = {sample}`", axes[0], axes[1])
    };
    match problem {
        PatchProblem::Outside { along, ends, face } => {
            let (axis, half) = (axes[*along], 0.5 * (ends[1] - ends[0]));
            let [low, high] = [face[0] + half, face[1] - half].map(|value| along_axis(value, axis));
            match 2.0 * half > face[1] - face[0] {
                true => {
                    format!("the face is {} long along {axis}", along_axis(face[1] - face[0], axis))
                }
                false => format!(
                    "`centre` is counted from where the axes of the grid begin: along {axis} it can \
                     be {low} to {high}"
                ),
            }
        }
        PatchProblem::CurvedFace => rectangle("[\"90 deg\", \"20 mm\"]"),
        PatchProblem::NotADisc => {
            let ring = rectangle("[\"5 mm\", \"360 deg\"]");
            format!("leave `centre` out, or {ring}, with its middle radius in `centre`")
        }
        PatchProblem::Moved => {
            "shares of heat follow from the values in the file: write the new ones there".to_owned()
        }
        PatchProblem::Unknown => "check its values".to_owned(),
    }
}
