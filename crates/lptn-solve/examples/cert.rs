#[path = "../tests/common/mod.rs"] mod common;
#[path = "../tests/certificate.rs"] mod certificate;
fn main() { if std::env::args().count() > 1 { certificate::shown(); } certificate::nonlinear(); }
