//! Medians, dispersions and probabilities of points with several runs.

use crate::{Condition, Data, Place, Row, Study, Table, Values};
use statrs::distribution::{ContinuousCDF, Normal};

/// Confidence of the intervals of probabilities.
const CONFIDENCE: f64 = 0.9;

/// How numbers spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// How many there are.
    pub count: usize,
    /// Median.
    pub median: f64,
    /// 16 % lie below.
    pub low: f64,
    /// 84 % lie below.
    pub high: f64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the logarithm; none where a number is not above 0 or there is only one.
    pub dispersion: Option<f64>,
}

impl Spread {
    /// Of some numbers; none of none.
    #[must_use]
    pub fn of(numbers: &[f64]) -> Option<Self> {
        let mut all = numbers.to_vec();
        all.sort_by(f64::total_cmp);
        let count = all.len();
        if count == 0 {
            return None;
        }
        let mean = all.iter().sum::<f64>() / count as f64;
        let logarithms: Vec<f64> = all.iter().map(|x| x.ln()).collect();
        let centre = logarithms.iter().sum::<f64>() / count as f64;
        let square: f64 = logarithms.iter().map(|x| (x - centre) * (x - centre)).sum();
        let dispersion = (count > 1 && all[0] > 0.0).then(|| (square / (count - 1) as f64).sqrt());
        Some(Self {
            count,
            median: quantile(&all, 0.5),
            low: quantile(&all, 0.16),
            high: quantile(&all, 0.84),
            mean,
            dispersion,
        })
    }

    /// Half of the band of 16 % to 84 %, over the absolute value of the median.
    #[must_use]
    pub fn relative(&self) -> f64 {
        let half = 0.5 * (self.high - self.low);
        if half == 0.0 { 0.0 } else { half / self.median.abs() }
    }
}

/// Between the sorted numbers, linear in the rank (type 7 of Hyndman and Fan 1996).
pub(crate) fn quantile(sorted: &[f64], p: f64) -> f64 {
    let at = p * (sorted.len() - 1) as f64;
    let i = at.floor() as usize;
    let next = sorted[(i + 1).min(sorted.len() - 1)];
    // Equal infinities would otherwise leave no number.
    if next == sorted[i] { next } else { sorted[i] + (at - i as f64) * (next - sorted[i]) }
}

/// Wilson's interval of a probability from `hits` of `count` trials (Wilson 1927).
#[must_use]
pub fn wilson(hits: usize, count: usize, confidence: f64) -> (f64, f64) {
    if count == 0 {
        return (0.0, 1.0);
    }
    let z = Normal::standard().inverse_cdf(0.5 + 0.5 * confidence);
    let n = count as f64;
    let p = hits as f64 / n;
    let centre = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + z * z / n;
    // The ends are exact where all or none hit.
    let low = if hits == 0 { 0.0 } else { (centre - half) / scale };
    let high = if hits == count { 1.0 } else { (centre + half) / scale };
    (low, high)
}

/// The runs of one point.
#[derive(Debug)]
pub(crate) struct Group<'a> {
    /// The point, with sample and member 0 and the axes under statistics at their first value.
    pub place: Place,
    pub runs: Vec<Row<'a>>,
    /// For each run that was left out beyond the limit of its series: the run that met the limit.
    pub stopped: Vec<Row<'a>>,
}

/// What the members of a point say about its nominal case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sensitivity {
    /// Largest scatter of a column over the scatter of the parameters.
    pub amplification: f64,
    /// The members do not agree whether the body overturns.
    pub divided: bool,
    /// Nominal cases of the point.
    pub cases: usize,
    /// Those of them whose members do not agree, or scatter beyond the limit.
    pub sensitive: usize,
}

impl Study {
    /// True where points have several runs.
    pub(crate) fn has_groups(&self) -> bool {
        self.plan.samples.is_some() || self.plan.ensemble.is_some() || !self.over.is_empty()
    }

    /// The runs by points, in the order of their first run.
    pub(crate) fn groups<'a>(&self, runs: &'a [Row<'a>]) -> Vec<Group<'a>> {
        let mut found: Vec<Group<'a>> = Vec::new();
        let mut index = std::collections::HashMap::new();
        let mut group = |run: usize, found: &mut Vec<Group<'a>>| {
            let mut place = self.plan.place(run);
            (place.sample, place.member) = (0, 0);
            self.over.iter().for_each(|axis| place.axes[*axis] = 0);
            *index.entry(place.clone()).or_insert_with(|| {
                found.push(Group { place, runs: Vec::new(), stopped: Vec::new() });
                found.len() - 1
            })
        };
        let length = self.plan.chain_length();
        for (k, own) in runs.iter().enumerate() {
            let i = group(own.run(), &mut found);
            found[i].runs.push(*own);
            let end = (own.run() / length + 1) * length;
            let next = runs.get(k + 1).map_or(end, |r| r.run().min(end));
            let met = self.stop.as_ref().is_some_and(|c| c.holds(&self.columns, *own));
            for run in (own.run() + 1..next).filter(|_| met) {
                let i = group(run, &mut found);
                found[i].stopped.push(*own);
            }
        }
        found.retain(|g| !g.runs.is_empty());
        found.sort_by_key(|g| g.runs[0].run());
        found
    }

    /// Good values of a column in a group.
    pub(crate) fn spread(&self, group: &Group<'_>, column: usize) -> Option<Spread> {
        let values = group.runs.iter().filter_map(|r| r.value(column));
        Spread::of(&values.collect::<Vec<_>>())
    }

    /// None without an ensemble. Where a point holds several nominal cases, such as those of several records,
    /// each is judged by its own members.
    pub(crate) fn sensitivity(&self, group: &Group<'_>) -> Option<Sensitivity> {
        let ensemble = self.plan.ensemble.as_ref()?;
        let given = ensemble.scatter.iter().map(|s| s * s).sum::<f64>().sqrt();
        let mut cases: Vec<(Place, Vec<&Row>)> = Vec::new();
        for r in &group.runs {
            let place = Place { member: 0, ..self.plan.place(r.run()) };
            match cases.iter_mut().find(|c| c.0 == place) {
                Some(case) => case.1.push(r),
                None => cases.push((place, vec![r])),
            }
        }
        let mut all =
            Sensitivity { amplification: 0.0, divided: false, cases: cases.len(), sensitive: 0 };
        for (_, runs) in &cases {
            let values = |i: usize| runs.iter().filter_map(|r| r.value(i)).collect::<Vec<_>>();
            let spread = |i| Spread::of(&values(i));
            let spreads = (0..self.columns.len()).filter_map(spread);
            let amplification = spreads.map(|s| s.relative() / given).fold(0.0, f64::max);
            let good = runs.iter().filter(|r| r.good()).count();
            let fallen = runs.iter().filter(|r| r.good() && r.overturned()).count();
            let divided = fallen > 0 && fallen < good;
            all.amplification = all.amplification.max(amplification);
            all.divided |= divided;
            all.sensitive += usize::from(divided || amplification > self.sensitive_above);
        }
        Some(all)
    }

    /// Overturning, where any body can, and the events of the study.
    pub(crate) fn counted(&self, runs: &[Row<'_>]) -> Vec<(String, Condition)> {
        let mut all = self.events.clone();
        if runs.iter().any(|r| r.overturned()) {
            all.insert(0, ("overturned".to_owned(), Condition::Overturned));
        }
        all
    }

    /// A row for each point with several runs.
    pub(crate) fn statistics(&self, runs: &[Row<'_>]) -> Table {
        let groups = self.groups(runs);
        let mut columns = Vec::new();
        let mut add = |name: String, unit: &str, values| {
            columns.push(Data { name, unit: unit.to_owned(), values });
        };
        let count = |n: usize| i64::try_from(n).ok();
        for (i, axis) in self.plan.axes.iter().enumerate().filter(|(i, _)| !self.over.contains(i)) {
            let value = |g: &Group<'_>| Some(axis.values[g.place.axes[i]].clone());
            add(axis.name.clone(), "", Values::Texts(groups.iter().map(value).collect()));
        }
        if self.plan.rows.len() > 1 {
            let point = |g: &Group<'_>| count(g.place.row + 1);
            add("point".into(), "", Values::Counts(groups.iter().map(point).collect()));
        }
        add(
            "runs".into(),
            "",
            Values::Counts(groups.iter().map(|g| count(g.runs.len())).collect()),
        );
        let failed = |g: &Group<'_>| count(g.runs.iter().filter(|r| !r.good()).count());
        add("failed".into(), "", Values::Counts(groups.iter().map(failed).collect()));
        if self.stop.is_some() {
            let left = |g: &Group<'_>| count(g.stopped.len());
            add("left_out".into(), "", Values::Counts(groups.iter().map(left).collect()));
        }
        for (i, column) in self.columns.iter().enumerate() {
            let spreads: Vec<_> = groups.iter().map(|g| self.spread(g, i)).collect();
            let mut part = |part: &str, unit: &str, of: &dyn Fn(&Spread) -> Option<f64>| {
                let values = spreads.iter().map(|s| s.as_ref().and_then(of)).collect();
                add(format!("{}_{part}", column.name), unit, Values::Numbers(values));
            };
            part("median", &column.unit, &|s| Some(s.median));
            part("16", &column.unit, &|s| Some(s.low));
            part("84", &column.unit, &|s| Some(s.high));
            part("mean", &column.unit, &|s| Some(s.mean));
            part("dispersion", "", &|s| s.dispersion);
            if self.plan.ensemble.is_some() && self.plan.samples.is_none() && self.over.is_empty() {
                let nominal = |g: &Group<'_>| {
                    let first = g.runs.iter().find(|r| self.plan.place(r.run()).member == 0)?;
                    first.value(i)
                };
                let values = groups.iter().map(nominal).collect();
                add(format!("{}_nominal", column.name), &column.unit, Values::Numbers(values));
            }
        }
        for (name, condition) in self.counted(runs) {
            let shares: Vec<_> = groups.iter().map(|g| self.share(g, &condition)).collect();
            for (part, k) in [("probability", 0), ("low", 1), ("high", 2)] {
                let values = shares.iter().map(|s| s.map(|s| s[k])).collect();
                add(format!("{name}_{part}"), "", Values::Numbers(values));
            }
        }
        if self.plan.ensemble.is_some() {
            let all: Vec<_> = groups.iter().map(|g| self.sensitivity(g)).collect();
            let amplification = all.iter().map(|s| s.map(|s| s.amplification)).collect();
            add("amplification".into(), "", Values::Numbers(amplification));
            let flags = all.iter().map(|s| s.map(|s| s.sensitive > 0)).collect();
            add("sensitive".into(), "", Values::Flags(flags));
            if !self.over.is_empty() || self.plan.samples.is_some() {
                let of = |part: fn(&Sensitivity) -> usize| {
                    Values::Counts(all.iter().map(|s| count(part(s.as_ref()?))).collect())
                };
                add("cases".into(), "", of(|s| s.cases));
                add("sensitive_cases".into(), "", of(|s| s.sensitive));
            }
        }
        Table { title: self.title.clone(), columns }
    }

    /// Share of the good runs of a group in which something happens, with its interval. What happened in every
    /// run that met the limit of its series counts for the runs left out beyond as well: otherwise those that
    /// fall early would make a fall look rare at strong motions.
    pub(crate) fn share(&self, group: &Group<'_>, condition: &Condition) -> Option<[f64; 3]> {
        let holds = |r: &Row<'_>| condition.holds(&self.columns, *r);
        let good: Vec<_> = group.runs.iter().copied().filter(|r| r.good()).collect();
        let beyond = if group.stopped.iter().all(holds) { group.stopped.len() } else { 0 };
        let hits = good.iter().filter(|r| holds(r)).count() + beyond;
        let count = good.len() + beyond;
        let (low, high) = wilson(hits, count, CONFIDENCE);
        (count > 0).then(|| [hits as f64 / count as f64, low, high])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_type_seven() {
        let s = Spread::of(&[4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!((s.median, s.mean), (2.5, 2.5));
        assert!((s.low - 1.48).abs() < 1e-12 && (s.high - 3.52).abs() < 1e-12, "{s:?}");
        // ln 2 · standard deviation of 0, 1, 2.
        let s = Spread::of(&[1.0, 2.0, 4.0]).unwrap();
        assert!((s.dispersion.unwrap() - 2f64.ln()).abs() < 1e-15);
        assert_eq!(Spread::of(&[0.0, 1.0]).unwrap().dispersion, None);
        assert_eq!(Spread::of(&[]), None);
    }

    #[test]
    fn the_interval_is_wilsons() {
        // Newcombe 1998, Stat. Med. 17, table I: 81 of 263 and 15 of 148 and 0 of 20, 95 %.
        for (hits, n, low, high) in
            [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611)]
        {
            let (a, b) = wilson(hits, n, 0.95);
            assert!((a - low).abs() < 5e-5 && (b - high).abs() < 5e-5, "{hits}/{n}: {a} {b}");
        }
        assert_eq!(wilson(20, 20, 0.95).1, 1.0);
    }
}
