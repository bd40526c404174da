use lptn_assembly::ThermalSystem;
use lptn_solve::Transient;
fn main() {
    for path in std::env::args().skip(1) {
        let net = match lptn_netlist::read(std::path::Path::new(&path)) { Ok(n) => n, Err(e) => { println!("{path}: {}", format!("{e:?}").lines().next().unwrap_or("")); continue; } };
        let Some(run) = &net.run else { continue };
        let system = match ThermalSystem::assemble(&net.network) { Ok(s) => s, Err(e) => { println!("{path}: {e}"); continue; } };
        if net.network.nodes().len() > 300 { continue; }
        let mut settings = Transient::of(&net.network, run);
        let begin = std::time::Instant::now();
        let _ = settings.solve(&system);
        let plain = begin.elapsed();
        settings.certify = true;
        let begin = std::time::Instant::now();
        match settings.solve(&system) {
            Err(e) => println!("{path}: RUN {}", format!("{e:?}").lines().next().unwrap_or("")),
            Ok(s) => match s.certificate() {
                Some(Ok(_)) => { let m = net.network.node_ids().filter_map(|id| s.largest_bound(id)).fold(0.0, f64::max); println!("{path}: PROVEN {m:.1e} at {:.0e}; {:?} nodes {} steps {}; plain {plain:?} certified {:?}", settings.tolerance, s.method(), net.network.nodes().len(), s.statistics().steps, begin.elapsed()); }
                Some(Err(e)) => println!("{path}: no: {e}"),
                None => println!("{path}: none"),
            },
        }
    }
}
