//! Tests of the core of live pages.
mod same;
