//! Which runs a study has: a number for each, and the values of the parameters that it stands for.

/// Values of a parameter one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Parameter of the model.
    pub name: String,
    /// Values as `--set` takes them.
    pub values: Vec<String>,
}

/// Values of several parameters drawn together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Parameters of the model.
    pub names: Vec<String>,
    /// A list of values for each sample.
    pub values: Vec<Vec<String>>,
}

/// Factors on parameters: the first member has 1 everywhere and is the nominal case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ensemble {
    /// Parameters of the model.
    pub names: Vec<String>,
    /// A list of factors for each member.
    pub factors: Vec<Vec<f64>>,
    /// Standard deviation of the logarithm of each parameter's factors, as drawn.
    pub scatter: Vec<f64>,
}

/// The runs of a study. Runs are numbered from 0; from the slowest to the fastest change rows, samples, axes,
/// members of the ensemble and the axis that runs stop along.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Values that all runs have.
    pub fixed: Vec<(String, String)>,
    /// Values given point by point; empty: one point without values.
    pub rows: Vec<Vec<(String, String)>>,
    /// Grid.
    pub axes: Vec<Axis>,
    /// Random samples.
    pub samples: Option<Samples>,
    /// Ensemble about every point.
    pub ensemble: Option<Ensemble>,
    /// Axis along which runs stop.
    pub chain: Option<usize>,
}

/// Where a run stands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// Row.
    pub row: usize,
    /// Sample.
    pub sample: usize,
    /// Value of each axis.
    pub axes: Vec<usize>,
    /// Member of the ensemble.
    pub member: usize,
}

impl Plan {
    fn members(&self) -> usize {
        self.ensemble.as_ref().map_or(1, |e| e.factors.len())
    }

    fn samples(&self) -> usize {
        self.samples.as_ref().map_or(1, |s| s.values.len())
    }

    /// Runs that follow each other along the axis that runs stop along; 1 without one.
    #[must_use]
    pub fn chain_length(&self) -> usize {
        self.chain.map_or(1, |axis| self.axes[axis].values.len())
    }

    /// Number of runs; none where it is beyond all bounds.
    #[must_use]
    pub fn runs(&self) -> Option<usize> {
        let axes = self.axes.iter().map(|a| a.values.len());
        let all = [self.rows.len().max(1), self.samples(), self.members()];
        axes.chain(all).try_fold(1usize, usize::checked_mul)
    }

    /// Where a run stands.
    #[must_use]
    pub fn place(&self, run: usize) -> Place {
        let mut rest = run;
        let mut take = |count: usize| {
            let index = rest % count;
            rest /= count;
            index
        };
        let mut axes = vec![0; self.axes.len()];
        if let Some(axis) = self.chain {
            axes[axis] = take(self.axes[axis].values.len());
        }
        let member = take(self.members());
        for (i, axis) in self.axes.iter().enumerate().rev() {
            if self.chain != Some(i) {
                axes[i] = take(axis.values.len());
            }
        }
        let sample = take(self.samples());
        Place { row: take(self.rows.len().max(1)), sample, axes, member }
    }

    /// The values of a place but for the factors of the ensemble, by parameter.
    #[must_use]
    pub fn nominal(&self, place: &Place) -> Vec<(String, String)> {
        let mut all = self.fixed.clone();
        all.extend(self.rows.get(place.row).into_iter().flatten().cloned());
        for (axis, i) in self.axes.iter().zip(&place.axes) {
            // An axis without values is told by the reader of the study.
            all.extend(axis.values.get(*i).map(|v| (axis.name.clone(), v.clone())));
        }
        if let Some(samples) = &self.samples {
            all.extend(samples.names.iter().cloned().zip(samples.values[place.sample].clone()));
        }
        all
    }

    /// Factors of a member, by parameter; none for the nominal one.
    pub fn factors(&self, member: usize) -> impl Iterator<Item = (&str, f64)> {
        let all = self.ensemble.iter().filter(move |_| member > 0);
        all.flat_map(move |e| {
            e.names.iter().map(String::as_str).zip(e.factors[member].iter().copied())
        })
    }

    /// The parameters that differ between runs, in the order of a table.
    #[must_use]
    pub fn varied(&self) -> Vec<&str> {
        let rows = self.rows.iter().flatten().map(|(n, _)| n.as_str());
        let axes = self.axes.iter().map(|a| a.name.as_str());
        let samples = self.samples.iter().flat_map(|s| &s.names).map(String::as_str);
        let ensemble = self.ensemble.iter().flat_map(|e| &e.names).map(String::as_str);
        let mut all: Vec<&str> = Vec::new();
        for name in rows.chain(axes).chain(samples).chain(ensemble) {
            if !all.contains(&name) {
                all.push(name);
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_place_has_one_number_and_the_chain_is_the_fastest() {
        let axis = |name: &str, n: usize| Axis {
            name: name.into(),
            values: (0..n).map(|i| i.to_string()).collect(),
        };
        let plan = Plan {
            rows: vec![vec![("r".into(), "1".into())], vec![("r".into(), "2".into())]],
            axes: vec![axis("a", 3), axis("s", 4), axis("b", 2)],
            samples: Some(Samples { names: vec!["x".into()], values: vec![vec!["7".into()]; 3] }),
            ensemble: Some(Ensemble {
                names: vec!["m".into()],
                factors: vec![vec![1.0]; 5],
                scatter: vec![0.1],
            }),
            chain: Some(1),
            ..Plan::default()
        };
        let runs = plan.runs().unwrap();
        assert_eq!(runs, 2 * 3 * 4 * 2 * 3 * 5);
        let places: HashSet<Place> = (0..runs).map(|run| plan.place(run)).collect();
        assert_eq!(places.len(), runs);
        for run in 0..4 {
            assert_eq!(plan.place(run).axes, [0, run, 0]);
        }
        assert_eq!(plan.place(4).member, 1);
        assert_eq!(plan.varied(), ["r", "a", "s", "b", "x", "m"]);
    }
}
