//! Text on signals that a record does not determine.

use lptn_fit::infer::Rival;
use lptn_network::list_of;

use super::InferAnswer;

impl InferAnswer {
    /// Names the unknowns that the record cannot distinguish from each signal, and remedies.
    pub(super) fn lacking(&self) -> String {
        let courses = self.found.courses.iter().enumerate();
        let mut said: Vec<Vec<Rival>> = Vec::new();
        let mut parts: Vec<String> = Vec::new();
        for (j, rivals) in courses.filter_map(|(j, own)| Some((j, own.rivals.as_ref()?))) {
            let mut all = [&[Rival::Estimated(j)], rivals.as_slice()].concat();
            let (own, others) = (self.listed(&all[..1]), self.listed(rivals));
            all.sort();
            // `P` from `Q` says the same as `Q` from `P`
            if !said.contains(&all) {
                parts.push(format!("{own} from {others}"));
                said.push(all);
            }
        }
        let mut all = said.concat();
        all.sort();
        all.dedup();
        format!(
            "not determined: the record cannot distinguish {}; {}",
            parts.join(", or "),
            self.remedies(&all)
        )
    }

    fn remedies(&self, all: &[Rival]) -> String {
        let of = |is: fn(&Rival) -> bool| -> Vec<Rival> {
            all.iter().filter(|rival| is(rival)).copied().collect()
        };
        let known = of(|rival| matches!(rival, Rival::Parameter(_) | Rival::Sensor { .. }));
        let estimated = of(|rival| matches!(rival, Rival::Estimated(_)));
        let mut remedies: Vec<String> = Vec::new();
        if !known.is_empty() {
            remedies.push(format!("give {} a smaller `±`", self.listed(&known)));
        }
        if all.iter().any(|rival| matches!(rival, Rival::Start(_))) {
            remedies.push("begin at known temperatures (`initial = \"network\"`)".to_owned());
        }
        if estimated.len() > 1 {
            remedies.push(format!("find only one of {}", self.listed(&estimated)));
        }
        remedies.push("measure another node".to_owned());
        remedies.join(", or ")
    }

    fn listed(&self, rivals: &[Rival]) -> String {
        let names: Vec<String> = rivals.iter().map(|rival| self.rival(*rival)).collect();
        list_of(&names, "unknowns")
    }

    fn rival(&self, rival: Rival) -> String {
        let network = &self.input.netlist.network;
        match rival {
            Rival::Estimated(j) => self.task.estimated[j].name.clone(),
            Rival::Parameter(k) => {
                let id = self.task.uncertain[k].parameter;
                network.parameters()[id.index()].name.clone()
            }
            Rival::Sensor { sensor, gain } => self.instrument((sensor, gain)),
            Rival::Start(node) => format!("{}.T0", network.nodes()[node.index()].name),
        }
    }
}
