//! The tests of `lptn-cli` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    clippy::unwrap_used,
    reason = "modules of tests, and tables that some of them share; a test fails by panicking"
)]

mod appearance;
mod balance;
mod branches;
mod browser;
mod carried_on;
mod case_signals;
mod cases;
mod certified_answers;
mod certify;
mod commands_page;
mod common;
mod compare;
mod compare_cycles;
mod completion;
mod deviations;
mod documents;
mod events;
mod events_verbs;
mod every_page;
mod exit_codes;
mod expand;
mod explain;
mod families;
mod faults;
mod files;
mod fit_compare;
mod fit_law;
mod fit_law_folder;
mod fit_network;
mod fit_pages;
mod fit_pictures;
mod fit_step;
mod foster;
mod gear;
mod graph;
mod heat;
mod impedance;
mod import;
mod infer;
mod interrupt;
#[cfg(unix)]
#[path = "common/interrupt.rs"]
mod interrupt_helper;
mod json;
mod library;
mod limits;
mod live;
mod loggers;
mod lumping;
mod metamorphic;
mod numbers;
mod one_unit;
mod outputs;
mod over_time;
mod own_units;
#[path = "../../../tests/support/pages.rs"]
mod pages;
mod pasted;
mod periodic;
#[path = "common/picture.rs"]
mod picture;
mod plan;
mod plot;
mod plot_truth;
mod plot_views;
mod printed;
mod processors;
#[path = "../../../tests/support/prose.rs"]
mod prose;
mod proven_results;
mod random;
mod ranges;
mod rank;
mod reduce;
mod reduce_keep;
mod reduce_near;
mod reduce_verdict;
mod regression;
mod regression_studies;
mod report;
mod report_pages;
mod run_times;
mod schema;
mod schemas;
mod seams;
mod signal_files;
mod size;
mod size_designs;
mod size_moments;
mod states;
mod sweep;
mod sweep_larger;
mod sweep_linear;
mod sweep_resume;
mod taken;
mod uncertainty;
mod valves;
mod verify;
mod warm_start;
mod words;
mod written;
