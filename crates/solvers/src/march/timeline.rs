//! Output times, and the segments of output steps between which loads bend or jump.
//!
//! Between the ends of a step a load runs straight, so no step goes across a sample of a table or the edge of a
//! pulse, and none is longer than what follows a sine. The matrices of a step are kept by its length, to the bit:
//! segments lie on fractions of the output step wherever the samples do.

use trilith_model::{Corner, Stretch};
use trilith_system::LoadSet;

/// Output times and, between them, the segments that end where a load bends or jumps.
pub(crate) struct Timeline {
    pub dt: f64,
    pub steps: usize,
    pub duration: f64,
    /// Where a load may jump, rising.
    jumps: Vec<f64>,
    /// Output steps that are cut, rising, and where their segments end among all of these.
    cut: Vec<(usize, usize)>,
    segments: Vec<Segment>,
    /// Where loads are curved, and the longest segments there.
    stretches: Vec<Stretch>,
    /// A bit for every output step that is one segment as long as the others, without a jump at its ends: most are, and
    /// nothing has to be looked for there.
    plain: Vec<u64>,
}

/// A segment of an output step; its length is that of other steps to the bit where it is a whole one or a fraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    pub start: f64,
    pub end: f64,
    pub length: f64,
}

impl Segment {
    /// Time at a share of it; the end to the bit.
    pub(crate) fn time(&self, share: f64) -> f64 {
        if share == 1.0 { self.end } else { self.start + self.length * share }
    }

    /// One of equal parts of it.
    pub(crate) fn part(&self, i: usize, count: usize) -> Self {
        let length = self.length / count as f64;
        let time = |i: usize| if i == count { self.end } else { self.start + length * i as f64 };
        Self { start: time(i), end: time(i + 1), length }
    }

    /// Equal parts of it.
    pub(crate) fn parts(self, count: usize) -> impl Iterator<Item = Self> {
        (0..count).map(move |i| self.part(i, count))
    }
}

/// Jumps closer than this share of the output step are one, and lengths closer than it are the same.
const NEAR: f64 = 1e-9;
/// A segment may end this share of the distance to the next sample away from a corner of a table, where steps are made of
/// what the load is then: the corner is inside a step, whose error shows it. Times in files are rounded.
const MOVED: f64 = 1e-4;
/// Share of a part of the output step up to which such a place is meant, and not met by chance.
const MEANT: f64 = 5e-4;
/// Samples are looked for on fractions of the output step down to this.
const FRACTIONS: usize = 128;
/// Halvings of a segment at most, for the sake of curved loads.
const HALVINGS: i32 = 20;

impl Timeline {
    /// `substeps`: steps that are made of a segment at least.
    pub(crate) fn new(dt: f64, duration: f64, loads: &LoadSet, substeps: usize) -> Self {
        let steps = trilith_model::output_steps(duration, dt) as usize;
        let mut stretches = loads.stretches();
        stretches.iter_mut().for_each(|s| s.step *= substeps.max(1) as f64);
        stretches.retain(|s| s.step < dt);
        let jumps = loads.breaks(duration);
        let (cut, segments, plain) = (Vec::new(), Vec::new(), Vec::new());
        let mut timeline = Self { dt, steps, duration, jumps, cut, segments, stretches, plain };
        timeline.cut(&loads.corners(duration, dt));
        timeline.join_lengths();
        let mut plain = vec![u64::MAX; steps.div_ceil(64)];
        timeline.cut_steps().into_iter().for_each(|step| plain[step / 64] &= !(1 << (step % 64)));
        timeline.plain = plain;
        timeline
    }

    #[inline]
    fn is_plain(&self, step: usize) -> bool {
        self.plain.get(step / 64).is_some_and(|bits| bits >> (step % 64) & 1 == 1)
    }

    /// An output step that is one segment as long as the others, without a jump at its ends.
    #[inline]
    pub(crate) fn plain(&self, step: usize) -> Option<Segment> {
        let segment =
            || Segment { start: self.time(step), end: self.time(step + 1), length: self.dt };
        self.is_plain(step).then(segment)
    }

    /// Time of an output step: that of a jump, to the bit, where one is there.
    #[inline]
    pub(crate) fn time(&self, step: usize) -> f64 {
        let t = (step as f64 * self.dt).min(self.duration);
        // A jump at an output time is at an end of two steps.
        if self.is_plain(step) || (step > 0 && self.is_plain(step - 1)) {
            return t;
        }
        self.jump_near(t).unwrap_or(t)
    }

    /// True for a time at which a load may jump.
    pub(crate) fn is_jump(&self, t: f64) -> bool {
        self.jump_near(t).is_some()
    }

    /// Output steps that may be something else than one segment as long as the others, or have a jump at their ends;
    /// rising.
    pub(crate) fn cut_steps(&self) -> Vec<usize> {
        let around = |t: f64| {
            let step = (t / self.dt) as usize;
            step.saturating_sub(1)..step + 2
        };
        let curved = self.stretches.iter().flat_map(|s| {
            let from = (s.from.max(0.0) / self.dt) as usize;
            let to = (s.to.min(self.duration) / self.dt) as usize;
            from.saturating_sub(1)..to + 2
        });
        let mut steps: Vec<usize> = self.cut.iter().map(|(step, _)| *step).collect();
        steps.extend(curved.chain(self.jumps.iter().flat_map(|t| around(*t))));
        steps.push(self.steps - 1);
        steps.retain(|step| *step < self.steps);
        steps.sort_unstable();
        steps.dedup();
        steps
    }

    /// The segments of an output step.
    #[inline]
    pub(crate) fn pieces(&self, step: usize) -> Segments<'_> {
        let now = self.whole(step);
        match self.cut.binary_search_by_key(&step, |(step, _)| *step) {
            Ok(at) => {
                let first = at.checked_sub(1).map_or(0, |before| self.cut[before].1);
                let rest = &self.segments[first..self.cut[at].1];
                Segments { timeline: self, now, made: 0, of: 0, rest }
            }
            Err(_) => Segments { timeline: self, now, made: 0, of: self.count(&now), rest: &[] },
        }
    }

    /// An output step in one; the last may be shorter, one that is not has the length of the others to the bit.
    #[inline]
    fn whole(&self, step: usize) -> Segment {
        let (start, end) = (self.time(step), self.time(step + 1));
        let as_others = (end - start - self.dt).abs() <= self.near();
        Segment { start, end, length: if as_others { self.dt } else { end - start } }
    }

    /// Parts of a segment that are short enough for curved loads: a power of two, so that their matrices are those of
    /// a step that is halved.
    fn count(&self, segment: &Segment) -> usize {
        if self.stretches.is_empty() {
            return 1;
        }
        let near = self.near();
        let meets = |s: &&Stretch| s.from < segment.end - near && s.to > segment.start + near;
        let shortest = self.stretches.iter().filter(meets).map(|s| s.step);
        let longest = shortest.fold(f64::INFINITY, f64::min);
        let halvings = (segment.length / longest * (1.0 - NEAR)).log2().ceil();
        1 << (halvings.max(0.0) as i32).min(HALVINGS)
    }

    /// How far from a corner a segment may end.
    fn reach(&self, corner: &Corner) -> f64 {
        MOVED * corner.reach.min(self.dt)
    }

    /// Enters what is inside output steps: jumps and corners.
    fn cut(&mut self, corners: &[Corner]) {
        let mut inside: Vec<(usize, Cut)> = Vec::new();
        let mut enter = |t: f64, reach: f64| {
            let step = ((t / self.dt) as usize).min(self.steps - 1);
            // Rounding may have put it in the step before or behind.
            for step in [step.saturating_sub(1), step, step + 1] {
                let (start, end) = (self.time(step), self.time(step + 1));
                if step < self.steps && t > start + reach && t < end - reach {
                    inside.push((step, Cut { t, reach }));
                    break;
                }
            }
        };
        self.jumps.iter().for_each(|t| enter(*t, self.near()));
        corners.iter().for_each(|c| enter(c.t, self.reach(c)));
        inside.sort_by(|(_, a), (_, b)| a.t.total_cmp(&b.t));
        for group in inside.chunk_by(|(a, _), (b, _)| a == b) {
            let step = group[0].0;
            let cuts = apart(group.iter().map(|(_, cut)| *cut));
            let segments = divide(self.whole(step), &cuts, self.dt);
            self.segments.extend(segments);
            self.cut.push((step, self.segments.len()));
        }
    }

    /// Lengths that differ by rounding become one.
    fn join_lengths(&mut self) {
        let mut lengths: Vec<f64> = self.segments.iter().map(|p| p.length).collect();
        lengths.sort_by(f64::total_cmp);
        // The smallest of those that are close to each other stands for them.
        lengths.dedup_by(|next, kept| *next - *kept <= NEAR * *kept);
        for segment in &mut self.segments {
            let at = lengths.partition_point(|x| *x <= segment.length);
            segment.length = lengths[at.saturating_sub(1)];
        }
    }

    /// The jump at a time.
    #[inline]
    fn jump_near(&self, t: f64) -> Option<f64> {
        if self.jumps.is_empty() {
            return None;
        }
        let near = self.near();
        let at = self.jumps.partition_point(|x| *x < t - near);
        self.jumps.get(at).copied().filter(|x| *x <= t + near)
    }

    /// Jumps closer than this are one.
    fn near(&self) -> f64 {
        NEAR * self.dt
    }
}

/// The segments of an output step, each in as many equal parts as curved loads ask for.
pub(crate) struct Segments<'a> {
    timeline: &'a Timeline,
    now: Segment,
    /// Parts of it, those that were given and all.
    made: usize,
    of: usize,
    rest: &'a [Segment],
}

impl Iterator for Segments<'_> {
    type Item = Segment;

    #[inline]
    fn next(&mut self) -> Option<Segment> {
        if self.made == self.of {
            let (next, rest) = self.rest.split_first()?;
            (self.now, self.rest) = (*next, rest);
            (self.made, self.of) = (0, self.timeline.count(next));
        }
        self.made += 1;
        Some(self.now.part(self.made - 1, self.of))
    }
}

/// A time inside an output step at which a segment ends, and how far it may be moved.
#[derive(Clone, Copy)]
struct Cut {
    t: f64,
    reach: f64,
}

/// Cuts without those that may be moved to another one.
fn apart(all: impl Iterator<Item = Cut>) -> Vec<Cut> {
    let mut kept: Vec<Cut> = Vec::new();
    for cut in all {
        match kept.last_mut() {
            Some(last) if cut.t - last.t <= last.reach => *last = cut,
            Some(last) if cut.t - last.t <= cut.reach => {}
            _ => kept.push(cut),
        }
    }
    kept
}

/// An output step in segments.
fn divide(whole: Segment, cuts: &[Cut], dt: f64) -> Vec<Segment> {
    let ends = cuts.iter().map(|cut| cut.t).chain([whole.end]);
    let starts = [whole.start].into_iter().chain(cuts.iter().map(|cut| cut.t));
    let segment = |(start, end): (f64, f64)| Segment { start, end, length: end - start };
    let mut segments: Vec<Segment> = starts.zip(ends).map(segment).collect();
    let fractions = || (2..=FRACTIONS).find_map(|n| Some((n, places(whole, cuts, n)?)));
    if whole.length == dt
        && let Some((parts, places)) = fractions()
    {
        // What jumps does so at its own time.
        let place = |to: usize| whole.start + whole.length * (to as f64 / parts as f64);
        let moved = |cut: &Cut, to: usize| {
            let at = place(to);
            if (at - cut.t).abs() <= NEAR * dt { cut.t } else { at }
        };
        let ends = cuts.iter().zip(&places).map(|(cut, to)| moved(cut, *to));
        let ends: Vec<f64> = ends.chain([whole.end]).collect();
        let (mut from, mut start) = (0, whole.start);
        for ((segment, to), end) in
            segments.iter_mut().zip(places.into_iter().chain([parts])).zip(ends)
        {
            *segment = Segment { start, end, length: dt * ((to - from) as f64 / parts as f64) };
            (from, start) = (to, end);
        }
    }
    segments
}

/// The fractions of the output step on which all cuts are.
fn places(whole: Segment, cuts: &[Cut], parts: usize) -> Option<Vec<usize>> {
    let part = whole.length / parts as f64;
    let mut places = Vec::with_capacity(cuts.len());
    for cut in cuts {
        let place = ((cut.t - whole.start) / part).round();
        let off = cut.t - (whole.start + place * part);
        let place = place as usize;
        let follows = place > places.last().copied().unwrap_or(0) && place < parts;
        if !follows || off.abs() > cut.reach.min(MEANT * part) {
            return None;
        }
        places.push(place);
    }
    Some(places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use trilith_model::{AfterEnd, Harmonic, Interpolation, Table, TimeFunction};
    use trilith_system::{Channel, Track};

    fn loads(functions: Vec<TimeFunction>) -> LoadSet {
        let channel = |function| Channel {
            force: Vec::new(),
            deformation: Vec::new(),
            rate: Vec::new(),
            track: Track::Value { function, factor: 1.0 },
            conservative: false,
        };
        LoadSet { channels: functions.into_iter().map(channel).collect(), ..LoadSet::default() }
    }

    /// A zigzag with samples at these times.
    fn table(times: impl Iterator<Item = f64>) -> TimeFunction {
        let times: Vec<f64> = times.collect();
        let values = (0..times.len()).map(|i| f64::from(u8::from(i % 2 == 1))).collect();
        let table = Table::new(times, values, Interpolation::Linear, AfterEnd::Hold).unwrap();
        TimeFunction::Table(Arc::new(table))
    }

    fn sine(frequency: f64, start: f64, cycles: f64) -> TimeFunction {
        let cycles = Some(cycles);
        TimeFunction::Sine(Harmonic { amplitude: 1.0, frequency, cycles, start, phase: 0.0 })
    }

    fn all(timeline: &Timeline) -> Vec<Segment> {
        let segments: Vec<Segment> = (0..timeline.steps)
            .flat_map(|step| timeline.pieces(step).collect::<Vec<_>>())
            .collect();
        for two in segments.windows(2) {
            assert_eq!(two[0].end, two[1].start);
        }
        // What needs no search says what a search does.
        for step in 0..timeline.steps {
            let t = (step as f64 * timeline.dt).min(timeline.duration);
            assert_eq!(timeline.time(step), timeline.jump_near(t).unwrap_or(t));
            if let Some(plain) = timeline.plain(step) {
                assert_eq!(timeline.pieces(step).collect::<Vec<_>>(), [plain]);
                assert!(!timeline.is_jump(plain.start) && !timeline.is_jump(plain.end));
            }
        }
        let plain = (0..timeline.steps).filter(|step| timeline.plain(*step).is_some()).count();
        let cut = timeline.cut_steps().len();
        assert_eq!(plain + cut, timeline.steps);
        for p in &segments {
            assert!((p.end - p.start - p.length).abs() < 1e-8 * timeline.dt, "{p:?}");
        }
        segments
    }

    fn lengths(segments: &[Segment]) -> Vec<u64> {
        let mut lengths: Vec<u64> = segments.iter().map(|p| p.length.to_bits()).collect();
        lengths.sort_unstable();
        lengths.dedup();
        lengths
    }

    #[test]
    fn samples_on_output_times_cut_nothing() {
        for spacing in [0.01, 0.02, 0.05] {
            let record = table((0..2000).map(|i| f64::from(i) * spacing));
            let timeline = Timeline::new(0.01, 20.0, &loads(vec![record]), 1);
            let segments = all(&timeline);
            assert_eq!(segments.len(), 2000);
            assert_eq!(lengths(&segments), [0.01_f64.to_bits()]);
        }
    }

    #[test]
    fn samples_between_output_times_cut_steps_into_few_lengths() {
        for (spacing, dt, count) in
            [(0.005, 0.02, 1), (0.01, 0.025, 2), (1.0 / 300.0, 0.01, 1), (1.0 / 256.0, 0.005, 64)]
        {
            // Times as a file holds them.
            let times = (0..=4000).map(|i| format!("{:.7}", f64::from(i) * spacing));
            let times: Vec<f64> = times.map(|t| t.parse().unwrap()).collect();
            let timeline = Timeline::new(dt, 10.0, &loads(vec![table(times.iter().copied())]), 1);
            let segments = all(&timeline);
            let found = lengths(&segments);
            assert!(found.len() <= count, "{spacing} {dt}: {}", found.len());
            // No segment goes across a sample.
            for p in &segments {
                let inside = |t: &&f64| **t > p.start + 2e-3 * dt && **t < p.end - 2e-3 * dt;
                assert_eq!(times.iter().find(inside), None, "{p:?}");
            }
        }
    }

    #[test]
    fn lengths_that_differ_by_rounding_are_one() {
        let record = table((0..3000).map(|i| f64::from(i) * 0.004_73));
        let timeline = Timeline::new(0.02, 10.0, &loads(vec![record]), 1);
        let segments = all(&timeline);
        let whole = segments.iter().filter(|p| (p.length - 0.004_73).abs() < 1e-9).copied();
        assert_eq!(lengths(&whole.collect::<Vec<_>>()).len(), 1);
    }

    #[test]
    fn a_pulse_is_followed_whatever_the_output_step() {
        for substeps in [1, 3] {
            let timeline = Timeline::new(0.15, 1.5, &loads(vec![sine(5.0, 0.33, 1.0)]), substeps);
            let segments = all(&timeline);
            for p in &segments {
                let during = p.start < 0.53 - 1e-9 && p.end > 0.33 + 1e-9;
                let longest = 0.2 / 16.0 * substeps as f64;
                assert!(!during || p.length <= longest * (1.0 + 1e-9), "{p:?}");
                let halvings = (0.15 / p.length).log2();
                assert!(during || halvings == halvings.round() || p.length > 0.02, "{p:?}");
            }
            for edge in [0.33, 0.33 + 1.0 / 5.0] {
                assert!(segments.iter().any(|p| p.end == edge) && timeline.is_jump(edge));
            }
        }
    }

    /// A jump at an output time but for rounding is met from its own sides.
    #[test]
    fn an_output_time_beside_a_jump_is_that_of_the_jump() {
        let edge: f64 = 0.1 + 0.2;
        assert_ne!(edge.to_bits(), 0.3_f64.to_bits());
        let step = TimeFunction::Step { amplitude: 1.0, start: edge, end: None };
        let timeline = Timeline::new(0.3, 1.0, &loads(vec![step]), 1);
        assert_eq!(timeline.time(1).to_bits(), edge.to_bits());
        assert_eq!(all(&timeline).len(), timeline.steps);
    }

    #[test]
    fn a_corner_stays_where_it_is_beside_a_fraction_that_nobody_meant() {
        // 62/121 of the step is 2.7e-5 of it away.
        let corner = 0.071_22;
        let record = table([0.0, corner, 0.139].into_iter());
        let timeline = Timeline::new(0.139, 0.278, &loads(vec![record]), 1);
        assert!(all(&timeline).iter().any(|p| p.end == corner));
    }

    #[test]
    fn a_jump_is_never_moved_to_a_sample_beside_it() {
        let record = table((0..100).map(|i| f64::from(i) * 0.05));
        let step = TimeFunction::Step { amplitude: 1.0, start: 0.550_001, end: None };
        let timeline = Timeline::new(0.1, 1.0, &loads(vec![record, step]), 1);
        let segments = all(&timeline);
        assert!(segments.iter().any(|p| p.end == 0.550_001));
        assert!(segments.iter().all(|p| p.length > 0.01));
    }
}
