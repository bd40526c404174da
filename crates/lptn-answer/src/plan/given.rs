//! Doubts in fits whose records exist already.

use std::sync::Arc;

use lptn_fit::network::design::{DesignTask, GivenFit};
use lptn_netlist::Diagnostic;

use crate::fit::network::{FitNetworkAnswer, doubts as of_fit, verdict};
use crate::input::Input;

/// Doubts in them, each with the name of its fit.
pub(super) fn doubts(input: &Arc<Input>, task: &DesignTask) -> Vec<Diagnostic> {
    task.given_fits.iter().flat_map(|given| of_one(input, given)).collect()
}

fn of_one(input: &Arc<Input>, given: &GivenFit) -> Vec<Diagnostic> {
    let fits = &input.netlist.studies.fits;
    let Some(study) = fits.iter().find(|fit| fit.name == given.name) else { return Vec::new() };
    let of = (Arc::clone(input), study.clone());
    let answer = FitNetworkAnswer::new(of, given.task.clone(), given.fit.clone());
    // the plan may estimate values that the fit keeps fixed
    let own =
        |doubt: &Diagnostic| !matches!(doubt.code, "fit::taken_as_exact" | "fit::other_posterior");
    let named = |words: &str| format!("fit `{}`, whose records are there: {words}", given.name);
    let told = of_fit(&answer).into_iter().filter(own);
    let told = told.map(|doubt| Diagnostic { message: named(&doubt.message), ..doubt });
    let open = (!answer.is_whole()).then(|| {
        let message = named(&verdict(&answer));
        Diagnostic::warning("plan::given_open", message)
            .at(study.span.clone(), "")
            .help("the plan is made for one of the values that these records allow")
    });
    told.chain(open).collect()
}
