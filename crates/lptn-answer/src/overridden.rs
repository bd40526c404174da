//! Values of a load case that other assignments replace.

use lptn_netlist::{Diagnostic, Netlist, Rejected, Severity};

/// Sets values after those of the load case that was taken, which a note names if they are replaced.
///
/// # Errors
/// An assignment that does not fit the netlist.
pub(crate) fn replace(
    netlist: &mut Netlist,
    of_case: &[String],
    assignments: &[String],
) -> Result<(), Rejected> {
    netlist.set(assignments)?;
    let notes: Vec<Diagnostic> = overridden(netlist.case(), of_case, assignments).collect();
    netlist.warnings.extend(notes);
    Ok(())
}

/// A note for each value of a load case that another assignment replaces.
fn overridden<'a>(
    case: Option<&'a str>,
    of_case: &'a [String],
    assignments: &'a [String],
) -> impl Iterator<Item = Diagnostic> + 'a {
    let name = |text: &'a String| text.split_once('=').map(|(name, _)| name.trim());
    let pairs = assignments
        .iter()
        .filter_map(move |new| Some((new, of_case.iter().find(|own| name(own) == name(new))?)));
    pairs.zip(std::iter::repeat(case)).filter_map(|((new, own), case)| {
        let message = format!("--set {new} replaces {own} of [case.{}]", case?);
        let note = Diagnostic::error("input::case_overridden", message);
        Some(Diagnostic { severity: Severity::Note, ..note })
    })
}
