//! Proven errors of the temperatures of a case.

use lptn_network::End;
use lptn_solve::Uncertified;

use super::answer::{Laboratory, Trouble, terms};
use super::expected::{Expected, Moment, Quantity};

/// The largest proven error of the temperatures in K, or the code of the reason why there is none;
/// `None` for a case that asks for no temperature.
pub type Proof = Option<Result<f64, String>>;

fn code(reason: &Uncertified) -> String {
    reason.code().to_owned()
}

impl Laboratory<'_> {
    /// The proof of all nodes: over the run if anything is asked of it, and in steady state.
    pub fn proof(&self) -> Result<Proof, Trouble> {
        let asks = |of: &dyn Fn(&Expected) -> bool| self.case.expected.iter().any(of);
        let mut found = Vec::new();
        if asks(&|expected| expected.latest() > 0.0) {
            let run = self.whole_run()?;
            let most = run.recorded().iter().filter_map(|id| run.largest_bound(*id));
            let most = most.fold(0.0, f64::max);
            let certificate = run.certificate().ok_or("a run that was not certified")?;
            found.push(certificate.as_ref().map(|_| most).map_err(code));
        }
        if asks(&|expected| expected.is_steady()) {
            let bounds = self.steady_bounds()?.as_ref();
            let most = bounds.map(|bounds| bounds.iter().copied().fold(0.0, f64::max));
            found.push(most.map_err(code));
        }
        Ok(found.into_iter().reduce(|a, b| Ok(f64::max(a?, b?))))
    }

    /// The proven error of a temperature in K; `None` for any other value, and if there is none.
    pub fn bound(&self, expected: &Expected) -> Option<f64> {
        let Quantity::T { node, minus, combine, t, .. } = &expected.quantity else { return None };
        let terms = terms(node.as_deref(), minus.as_deref(), combine.as_ref()).ok()?;
        let one = |(id, factor): (&str, f64)| {
            let End::Node(node) = self.end_named(id).ok()? else { return Some(0.0) };
            let bound = match t {
                Moment::Steady => self.steady_bounds().ok()?.as_ref().ok()?[node.index()],
                Moment::At(t) => {
                    let run = self.whole_run().ok()?;
                    let row = run.times().iter().position(|time| time.to_bits() == t.to_bits())?;
                    run.bounds(node)?[row]
                }
            };
            Some(factor.abs() * bound)
        };
        terms.into_iter().map(one).sum()
    }
}
