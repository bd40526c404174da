#[path = "../tests/common/mod.rs"] mod common;
#[path = "../tests/certificate.rs"] mod certificate;
fn main() { certificate::shown(); }
