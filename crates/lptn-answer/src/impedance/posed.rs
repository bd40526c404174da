//! An impedance of a network that is linear or taken for linear.

use lptn_network::NodeId;
use lptn_solve::{Drive, FrequencyResponse, Linearised, ModesError, ResponseError, StepAnswer};

use super::chain::Spectrum;
use super::curve::Curve;
use super::{Form, Found, ImpedanceQuestion, Stepped, Swung, failed, is_at, lists};
use crate::failure::Failure;
use crate::input::Input;

/// Range that is shown, in shortest and longest time constants.
const BEFORE: f64 = 0.1;
const AFTER: f64 = 5.0;

/// Question to a network that is linear or taken for linear.
pub(super) struct Posed<'a> {
    pub(super) question: &'a ImpedanceQuestion,
    pub(super) input: &'a Input,
    pub(super) linear: &'a Linearised<'a>,
    pub(super) drive: Drive,
    /// The node that answers.
    pub(super) to: NodeId,
}

impl Posed<'_> {
    /// The answer, from that to a step if it is known.
    /// `shares` are the parts of their periods that pulses take.
    pub(super) fn answer(
        &self,
        step: Result<StepAnswer, ResponseError>,
        shares: &[f64],
    ) -> Result<Found, Failure> {
        if let Form::Swing(list) = &self.question.form {
            return self.swing(list.as_deref(), step.as_ref().ok());
        }
        match step {
            Ok(step) => self.of_modes(&step, shares),
            Err(error) if is_large(&error) && self.is_own() && self.question.at.is_none() => {
                self.of_port(shares)
            }
            Err(error) => Err(failed(self.input, &error)),
        }
    }

    /// True if the node that responds is the heated one.
    fn is_own(&self) -> bool {
        is_at(&self.input.netlist.network, self.drive, self.to)
    }

    fn of_modes(&self, step: &StepAnswer, shares: &[f64]) -> Result<Found, Failure> {
        let node = self.to.index();
        match self.question.form {
            Form::Chain { .. } if !step.has_terms() => {
                Err(failed(self.input, &ResponseError::Modes(ModesError::Defective)))
            }
            Form::Chain { count, ladder } => {
                let spectrum = Spectrum::of(step, (node, self.is_own()))?;
                Ok(Found::Chain(spectrum.chain(count, ladder)?))
            }
            _ => self.stepped(&Curve::Modes(step, node), shares),
        }
    }

    /// The response of the port of a large network, without all of its modes.
    fn of_port(&self, shares: &[f64]) -> Result<Found, Failure> {
        let spectrum = Spectrum::of_large(self.input, self.linear.system(), self.to)?;
        match self.question.form {
            Form::Chain { count, ladder } => Ok(Found::Chain(spectrum.chain(count, ladder)?)),
            _ => self.stepped(&Curve::from(&spectrum), shares),
        }
    }

    fn stepped(&self, curve: &Curve<'_>, shares: &[f64]) -> Result<Found, Failure> {
        let times = match &self.question.form {
            Form::Step { times: Some(list), .. } => lists::times(list)?,
            _ => {
                let (fastest, slowest) = curve.span().unwrap_or((1.0, 1.0));
                lists::three_a_decade(BEFORE * fastest, AFTER * slowest)
            }
        };
        let row = |time: f64| Stepped {
            time,
            rise: curve.value(time),
            pulses: shares.iter().map(|share| curve.pulse(time, *share)).collect(),
        };
        Ok(Found::Step { settled: curve.settled(), rows: times.into_iter().map(row).collect() })
    }

    fn swing(&self, list: Option<&str>, step: Option<&StepAnswer>) -> Result<Found, Failure> {
        let node = self.to.index();
        let omegas = match list {
            Some(list) => lists::omegas(list)?,
            None => {
                let span = step.and_then(|step| step.span(node)).unwrap_or((1.0, 1.0));
                lists::three_a_decade(BEFORE / span.1, 1.0 / (BEFORE * span.0))
            }
        };
        let answers = || {
            let mut response = FrequencyResponse::new(self.linear, self.drive)?;
            let one = |omega: f64| Ok(Swung { omega, answer: response.at(omega)?[node] });
            Ok(Found::Swing(omegas.into_iter().map(one).collect::<Result<_, ResponseError>>()?))
        };
        answers().map_err(|error| failed(self.input, &error))
    }
}

/// True if there are too many modes to compute all of them.
fn is_large(error: &ResponseError) -> bool {
    matches!(error, ResponseError::Modes(ModesError::TooLarge { .. }))
}
