//! Checks that the joint knowledge of parameters fits the network.

use lptn_data::{Diagnostic, Severity, Span};
use lptn_network::{Field, Item, Network, Parameters};
use lptn_units::{Distribution, Spread, Unit};

use super::file::Found;
use super::{UncertaintyPlan, WrittenCorrelation};
use crate::posterior::{Believed, PosteriorQuantity, problem};
use crate::source_map::SourceMap;

/// The posterior, which has to fit the network; written correlations go to `parameters`.
pub(crate) fn known(
    plan: &UncertaintyPlan,
    network: &Network,
    posterior: Found,
    parameters: &mut Parameters,
) -> Result<Option<Believed>, Vec<Diagnostic>> {
    plan.correlate(network, parameters);
    let believed = posterior.transpose().map_err(|problem| vec![problem])?;
    let believed = believed.map(|believed| believed.taken(plan.posterior.as_ref()));
    let mut problems = check(plan, network, believed.as_ref());
    if problems.is_empty() {
        problems.extend(joint(plan, network, parameters));
    }
    if problems.is_empty() { Ok(believed) } else { Err(problems) }
}

/// The errors of the correlations and the posterior.
pub(crate) fn check(
    plan: &UncertaintyPlan,
    network: &Network,
    believed: Option<&Believed>,
) -> Vec<Diagnostic> {
    let mut problems: Vec<Diagnostic> =
        believed.iter().flat_map(|believed| fits(believed, plan, network)).collect();
    let found = |name: &str| {
        let believed = believed?;
        let mut chosen = believed.chosen().map(|i| &believed.posterior.quantities[i]);
        chosen.find(|quantity| quantity.name == name)
    };
    for written in &plan.correlations {
        let wrong = |message: String, help: &str| {
            Diagnostic::wrong("netlist::correlation", message, &written.span, help)
        };
        let [a, b] = &written.between;
        if found(a).is_some() && found(b).is_some() {
            let message = format!("the posterior contains the correlation of `{a}` and `{b}`");
            let help = "leave this correlation out, or name the parameters to take of the posterior in \
                 `only`";
            problems.push(wrong(message, help));
            continue;
        }
        let certain = |name: &&String| {
            let own = network.parameter(name).ok();
            let own = own.and_then(|id| network.parameters()[id.index()].deviation);
            own.is_none_or(Spread::is_certain) && found(name).is_none_or(|q| q.spread.is_none())
        };
        if let Some(name) = [a, b].into_iter().find(certain) {
            let message = format!("`correlation` names `{name}`, which is certain");
            problems.push(wrong(message, "give it a `±` in [param], or leave the pair out"));
        }
    }
    problems
}

fn fits(believed: &Believed, plan: &UncertaintyPlan, network: &Network) -> Vec<Diagnostic> {
    let quantities = &believed.posterior.quantities;
    let named = believed.named.as_ref();
    let key = plan.posterior.as_ref().filter(|_| named.is_some());
    let only = key.and_then(|key| key.only.as_ref());
    let unknown = only
        .into_iter()
        .flatten()
        .filter(|(name, _)| quantities.iter().all(|quantity| quantity.name != *name));
    let mut problems: Vec<Diagnostic> = unknown
        .map(|(name, span)| {
            let message = format!("the posterior has no parameter `{name}`");
            let names = quantities.iter().map(|quantity| quantity.name.as_str());
            let list: Vec<&str> = names.clone().collect();
            Diagnostic::error("posterior::unknown_parameter", message)
                .at(span.clone(), "")
                .also(believed.top.clone(), "the posterior")
                .did_you_mean(name, names, || format!("it has {}", lptn_data::list(&list)))
        })
        .collect();
    if problems.is_empty() && believed.chosen().next().is_none() {
        let words = "the posterior has no parameter of this network";
        let help = "use the `posterior.json` of a fit that varies parameters of this netlist";
        problems.push(problem("posterior::nothing", words, believed.top.clone(), named).help(help));
    }
    for i in believed.chosen() {
        let at = (believed.places[i].clone(), named);
        problems.extend(one(&quantities[i], network, at));
    }
    problems
}

/// Error for a quantity that is not a parameter here, or one of another kind.
fn one(
    quantity: &PosteriorQuantity,
    network: &Network,
    (place, named): (Span, Option<&Span>),
) -> Option<Diagnostic> {
    let name = &quantity.name;
    let Ok(id) = network.parameter(name) else {
        let words =
            format!("the posterior has a parameter `{name}` that the netlist does not have");
        let names = network.parameters().iter().map(|parameter| parameter.name.as_str());
        let otherwise = || {
            "fit this netlist, or take a part of it: `posterior = { file = \"..\", only = [\"..\"] \
             }`"
            .to_owned()
        };
        let problem = problem("posterior::unknown_parameter", words, place, named);
        return Some(problem.did_you_mean(name, names, otherwise));
    };
    let ty = network.parameters()[id.index()].ty;
    let dimension = Unit::parse(&quantity.unit).ok().map(|unit| unit.ty.dimension);
    if dimension == Some(ty.dimension) && Unit::parse(&quantity.unit).is_ok_and(|u| is_si(&u)) {
        return None;
    }
    let words = format!(
        "`{name}` of the posterior is in {}, and the netlist has it in {}",
        quantity.unit,
        ty.dimension.si_unit()
    );
    let help = "a parameter of this name is something else here: rename one of the two";
    Some(problem("posterior::unit", words, place, named).help(help))
}

/// True if numbers in this unit are those of SI, points of temperature in K.
fn is_si(unit: &Unit) -> bool {
    (unit.scale - 1.0).abs() < f64::EPSILON && unit.offset.abs() < f64::EPSILON
}

/// Error for impossible correlations of the uncertain parameters.
pub(crate) fn joint(
    plan: &UncertaintyPlan,
    network: &Network,
    parameters: &Parameters,
) -> Option<Diagnostic> {
    let uncertain = parameters.uncertain();
    let ids: Vec<_> = uncertain.iter().map(|(id, _)| *id).collect();
    let distributions: Vec<Distribution> =
        uncertain.iter().map(|(_, spread)| spread.distribution).collect();
    let scores = parameters.correlations_of(&ids).of_scores(&distributions);
    let failed = scores.factor().err()?;
    let name = |i: usize| network.parameters()[ids[i].index()].name.as_str();
    let tied: Vec<&str> =
        (0..failed).filter(|&i| scores.between(i, failed).abs() > 0.0).map(name).collect();
    let message =
        format!("correlations that cannot be: `{}` with {}", name(failed), lptn_data::list(&tied));
    let here =
        |written: &&WrittenCorrelation| written.between.iter().any(|own| own == name(failed));
    let span = plan.correlations.iter().rfind(here).or(plan.correlations.last());
    let problem = Diagnostic::error("netlist::not_definite", message);
    let problem = problem.at(span.map(|written| written.span.clone()), "");
    Some(problem.help(
        "two values that follow a third one closely follow each other too: the matrix of all \
         correlations has to be positive definite",
    ))
}

/// A note for each parameter that is 0 and whose deviation is a part of its value, as after `--set`
/// or of a template.
pub(crate) fn of_zero<'a>(
    network: &'a Network,
    map: &'a SourceMap,
    parameters: &Parameters,
) -> impl Iterator<Item = Diagnostic> + 'a {
    let uncertain = parameters.uncertain().into_iter();
    let exact = uncertain.filter(|(id, spread)| spread.sigma(network.parameter_value(*id)) <= 0.0);
    exact.map(|(id, spread)| {
        let item = Item::Parameter(id);
        let name = network.name_of(item);
        let unit = network.parameters()[id.index()].ty.dimension.si_unit();
        let part = match spread.percent() {
            Some(percent) => format!("{percent} % of it"),
            None => "a factor on it".to_owned(),
        };
        let message = format!("`{name}` is 0, and {part} is 0 too: it counts as exact");
        let help = format!("give it a deviation in its unit, `--set \"{name}=0 ± 1 {unit}\"`");
        let note = Diagnostic::error("units::relative_deviation", message).help(help);
        Diagnostic { severity: Severity::Note, ..note.at(map.get(item, Field::Value), "") }
    })
}
