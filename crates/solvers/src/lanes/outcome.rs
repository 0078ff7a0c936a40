//! What is left at the end of a march, for each lane.

use super::LaneOutcome;
use super::record::Record;
use super::setup::LaneSetup;
use super::state::State;
use crate::record::{EnergyTotals, LinkEnergy, StartEnergy};
use trilith_element::lanes::{Arithmetic, Real};

/// Where all energy has left again, the error is measured against this share of the largest, and never
/// against less than this share of what stands in springs and loads; as in the ledger.
const SHARE_OF_LARGEST: f64 = 0.01;
const SHARE_OF_STANDING: f64 = 1e-6;

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    pub fn outcome<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        record: &Record<R>,
        setup: &LaneSetup,
        lane: usize,
        overturned: Option<(f64, usize)>,
    ) -> LaneOutcome {
        let of = |x: R| with.lane(x, lane);
        let heat = |kind: usize| -> f64 { record.heat.iter().map(|x| of(x[kind])).sum() };
        let potential = of(record.potential) - setup.potential;
        let start = StartEnergy {
            kinetic: setup.kinetic,
            strain: setup.strain,
            link_stored: setup.stored.iter().sum(),
        };
        let mut energy = EnergyTotals {
            start,
            input: of(record.external) + potential,
            kinetic: of(record.kinetic),
            strain: of(record.strain),
            potential,
            modal_damping: of(record.damping),
            link_stored: of(record.stored),
            link_hysteretic: heat(0),
            link_viscous: heat(1),
            ..EnergyTotals::default()
        };
        let e = &energy;
        let heat = e.modal_damping + e.link_hysteretic + e.link_viscous;
        let driven = start.kinetic + e.input;
        let (strained, charged) = (e.strain - start.strain, e.link_stored - start.link_stored);
        let error = driven - (e.kinetic + strained + e.potential + charged + heat);
        let standing =
            of(record.strain).abs() + of(record.stored).abs() + of(record.potential).abs();
        let shares = [SHARE_OF_LARGEST * of(record.largest), SHARE_OF_STANDING * standing];
        let size = [driven, e.kinetic, e.potential, heat]
            .into_iter()
            .chain(shares)
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        energy.error = error;
        energy.error_relative = if size > 0.0 { error.abs() / size } else { 0.0 };
        let alive = of(with.splat(1.0).only(self.alive)) == 1.0;
        let remembers = self.history.iter().all(|x| of(*x).is_finite());
        let finite = energy.error_relative.is_finite() && remembers;
        let grid = setup.shape.grid;
        let lost = match (alive, finite) {
            (true, true) => None,
            (true, false) => Some(grid.steps as f64 * grid.dt),
            (false, _) => Some(of(self.lost)),
        };
        // One that fell over is far from its place, and says why.
        let motion: Vec<f64> = self.q.iter().take(setup.shape.modes).map(|q| of(*q)).collect();
        let motion = if overturned.is_some() { &[][..] } else { &motion };
        LaneOutcome {
            lost,
            steps: of(record.count) as usize,
            overturned,
            iterations: of(self.iterations) as usize,
            outputs: record.peaks.of_lane(with, lane),
            integrals: record.peaks.integrals.iter().map(|(_, it)| of(it.value())).collect(),
            energy,
            link_energy: setup
                .elements
                .iter()
                .enumerate()
                .map(|(i, element)| {
                    let energy = LinkEnergy {
                        stored: of(self.steps[i].stored),
                        hysteretic: of(record.heat[i][0]),
                        viscous: of(record.heat[i][1]),
                    };
                    (*element, energy)
                })
                .collect(),
            contact: record.feet.of_lane(with, lane),
            noticed: setup.watch.notices(motion, record.feet.depth(with, lane)),
        }
    }
}
