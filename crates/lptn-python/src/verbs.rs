//! The questions of the command line, each with the function that asks it.

use crate::declaration::{About, Declaration, Kind, Opt};
use crate::questions as ask;
use crate::subject::{Asked, Found};
use crate::trouble::Trouble;
use crate::words::Words;

/// A question.
pub(crate) struct Verb {
    /// Its name, subject and options.
    pub(crate) declared: Declaration,
    /// Asks it.
    pub(crate) ask: fn(&Asked<'_>, &Words) -> Result<Found, Trouble>,
}

/// The question of this name whose subject is accepted.
pub(crate) fn named(name: &str, accepted: fn(About) -> bool) -> Result<&'static Verb, Trouble> {
    let mut found = VERBS.iter().map(|verb| (verb, &verb.declared));
    let found = found.find(|(_, declared)| declared.name == name && accepted(declared.about));
    let none = || Trouble::of_value(format!("there is no question `{name}` of this"));
    found.map(|(verb, _)| verb).ok_or_else(none)
}

/// Options, one a line: name, type, meaning.
macro_rules! options {
    ($($name:ident $kind:ident $means:literal;)*) => {
        &[$(Opt { name: stringify!($name), kind: Kind::$kind, means: $means },)*]
    };
}

/// Questions: subject, words, function, purpose, parameters or not, first option, options.
macro_rules! verbs {
    ($(
        $about:ident $name:literal $ask:ident $purpose:literal, sets $sets:literal, first $first:expr;
        { $($options:tt)* }
    )*) => {
        /// All questions.
        pub(crate) static VERBS: &[Verb] = &[$(Verb {
            declared: Declaration {
                name: $name,
                purpose: $purpose,
                about: About::$about,
                first: $first,
                sets: $sets,
                options: options! { $($options)* },
            },
            ask: ask::$ask,
        },)*];
    };
}

verbs! {
    Netlists "check" check "Check a netlist, and show all its problems", sets true, first None; {
        case Text "the load case, [case.NAME]";
    }
    Network "run" run "Simulate a network over time", sets true, first None; {
        case Text "the load case, [case.NAME]";
        stop Text "end of the run, such as \"2 h\"";
        every Text "interval between rows, such as \"10 s\"";
        select Texts "columns to keep, such as \"*.T\"";
        temperature_unit Text "degC, K, degF or degR";
        time_unit Text "s, min, h or d";
        balance Text "node or boundary whose heat balance is wanted";
        tolerance Text "tolerance of the integrator, such as \"1e-7 K\"";
        certify Flag "bound the error of each temperature, with proof";
        uncertainty Text "bands from every ±: linear or sobol";
        posterior Text "file of a fit with values and covariance";
        samples Count "base points of sobol, a power of two";
        seed Count "seed of sobol";
        threads Count "number of threads";
    }
    Network "steady" steady "Find the steady state of a network", sets true, first None; {
        case Text "the load case, [case.NAME]";
        select Texts "columns to keep, such as \"*.T\"";
        temperature_unit Text "degC, K, degF or degR";
        balance Text "node or boundary whose heat balance is wanted";
        certify Flag "bound the error of each temperature, with proof";
        periodic Flag "the periodic steady state of inputs that repeat";
        period Text "the period; default: that of the signals";
        tolerance Text "tolerance of the integrator, such as \"1e-7 K\"";
    }
    Network "modes" modes "List time constants and modes", sets true, first None; {
        case Text "the load case, [case.NAME]";
        count Count "number of modes";
        at Text "\"steady\" or a time: the operating point";
    }
    Network "verify" verify "Compare a run with an independent solution", sets true, first None; {
        case Text "the load case, [case.NAME]";
        tolerance Text "tolerance of the integrator, such as \"1e-7 K\"";
        at Text "\"steady\" or a time: the operating point";
    }
    Netlists "compare" compare "Compare designs", sets true, first None; {
        posterior Text "file of a fit with values and covariance";
        uncertainty Flag "count every ±";
        parts Texts "CSV files of parts, each of which is tried";
        cases Flag "every load case of every netlist";
        periodic Flag "compare periodic steady states";
        sort Text "margin, peak, steady, time, capacity or given";
        temperature_unit Text "degC, K, degF or degR";
        threads Count "number of threads";
    }
    Network "size" size "Find the value that keeps the limits", sets true, first Some("name"); {
        name Text "the study, [size.NAME]";
        posterior Text "file of a fit with values and covariance";
        certify Flag "bound the margins of the answer, with proof";
        threads Count "number of threads";
    }
    Nothing "size" cooling "Find the flow that removes a heat", sets false, first None; {
        power Text "the heat, such as \"500 W\"";
        limit Text "the highest temperature";
        ambient Text "the temperature of the surroundings";
        rise Text "the rise of the coolant";
    }
    Network "rank" rank "Rank the values that matter most for a node", sets true, first None; {
        case Text "the load case, [case.NAME]";
        of Text "the node; default: the hottest";
        over Text "steady or run";
        temperature_unit Text "degC, K, degF or degR";
    }
    Network "sweep" sweep "Solve many candidates", sets true, first Some("name"); {
        name Text "the study, [sweep.NAME]";
        case Text "the load case, [case.NAME]";
        temperature_unit Text "degC, K, degF or degR";
        shard Text "a part of all candidates: \"3/20\"";
        threads Count "number of threads";
    }
    Network "fit network" fit_network "Fit parameters to records", sets true, first Some("name"); {
        name Text "the study, [fit.NAME]";
        starts Count "number of starts";
    }
    Netlists "fit compare" fit_compare "Choose between networks by records", sets false, first None; {
        fit Texts "the studies, [fit.NAME]";
        starts Count "number of starts";
        threads Count "number of threads";
    }
    Nothing "fit step" fit_step "Fit one exponential to a record", sets false, first Some("record"); {
        record Text "the CSV file";
        column Texts "columns to fit; default: all temperatures";
        time Text "the column of times";
        from Text "leave out rows before this time";
        to Text "leave out rows after this time";
        drop_outliers Flag "leave out values far from their neighbours";
        capacity Text "C_eq, such as \"2659 J/K ± 5 %\"";
        reference Text "zero of the rise: initial, a column, or a temperature";
        sensor Text "accuracy class of the thermocouples";
        model Text "the network to state the bias of the method on";
        port Text "the node of the model that the thermocouple is on";
        terms Text "fit several exponentials: their number, or auto";
        power Text "heat of the step, such as \"1 W\"";
        temperature_unit Text "degC, K, degF or degR";
    }
    Nothing "fit law" fit_law "Fit laws over speed to points or records", sets false, first Some("points"); {
        points Text "the CSV file, or a folder of records";
        speed Text "the column of the speed";
        power Text "the column of the power";
        rise Text "the column of the temperature rise";
        time_constant Text "the column of the time constant";
        law Texts "further laws";
        start Texts "starts of coefficients, such as \"a = 20 mW/rpm\"";
        unweighted Flag "give every point the same weight";
        capacity Text "C_eq, such as \"2659 J/K ± 5 %\"";
        column Texts "columns of the records";
        reference Text "zero of the rise: initial, a column, or a temperature";
        sensor Text "accuracy class of the thermocouples";
        dT Text "without points: the law of the temperature rise";
        t_RC Text "without points: the law of the time constant";
        P Text "without points: the law of the power";
        over Text "without points: the speeds, \"1000 rpm to 7000 rpm\"";
    }
    Network "infer" infer "Estimate heat or temperature over time from records", sets true, first Some("name"); {
        name Text "the study, [infer.NAME]";
    }
    Network "plan" plan "Plan a measurement", sets true, first Some("name"); {
        name Text "the study, [plan.NAME]";
    }
    Network "reduce" reduce "Replace a network by a few nodes", sets true, first Some("port"); {
        case Text "the load case, [case.NAME]";
        port Text "the node that the rest is seen from";
        keep Texts "nodes to keep";
        max_error Text "largest error, such as \"5%\" or \"1 K\"";
        error Text "choose the number of nodes by this error";
        power Text "the power of the worst load";
        nodes Count "number of nodes";
        for Text "judge by the step or by the run";
        definition Text "the definition of the capacity";
        bias Flag "the bias of a fit of one exponential";
        window Text "the length of the record";
        at Text "\"steady\" or a time: the operating point";
        temperature_unit Text "degC, K, degF or degR";
    }
    Network "impedance" impedance "Compute step, pulse or frequency response", sets true, first Some("port"); {
        case Text "the load case, [case.NAME]";
        port Text "the node or source that is driven";
        to Text "the node that responds";
        time Text "times of the step response";
        duty Text "shares of pulses";
        omega FlagOrText "frequency response, perhaps at these frequencies";
        foster FlagOrText "a Foster chain, perhaps of this length";
        cauer FlagOrText "a Cauer ladder, perhaps of this length";
        at Text "\"steady\" or a time: the operating point";
    }
    Network "gear" gear "Losses and efficiency of a gearbox", sets true, first Some("name"); {
        name Text "the gearbox";
        case Text "the load case, [case.NAME]";
        speed Texts "speeds of a map";
        torque Texts "torques of a map";
        temperature Texts "temperatures of a map";
        temperature_unit Text "degC, K, degF or degR";
    }
}
