//! CPU time and memory of this process.

/// CPU time of the process so far, all threads, user and system, s. Wall-clock time where the system does not
/// tell.
#[must_use]
pub fn cpu() -> f64 {
    #[cfg(unix)]
    {
        let t = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
    }
    #[cfg(not(unix))]
    {
        static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
    }
}

/// CPU time of the child processes that have ended so far, s: in hundredths. NaN where the system does not tell.
#[must_use]
pub fn children_cpu() -> f64 {
    let status = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // Behind the name, which may hold anything, in ticks of a hundredth: user and system time of the children.
    let of = |fields: &str| {
        let mut ticks = fields.split_whitespace().skip(13).map(str::parse::<f64>);
        Some(0.01 * (ticks.next()?.ok()? + ticks.next()?.ok()?))
    };
    status.rsplit_once(')').and_then(|(_, fields)| of(fields)).unwrap_or(f64::NAN)
}

/// What a piece of work gives and its CPU time, s.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = cpu();
    let result = work();
    (result, cpu() - start)
}

/// Resident memory now, MB; 0 where the system does not tell.
#[must_use]
pub fn resident_mb() -> f64 {
    status_mb("VmRSS:")
}

/// Largest resident memory so far, MB; 0 where the system does not tell.
#[must_use]
pub fn peak_mb() -> f64 {
    status_mb("VmHWM:")
}

fn status_mb(key: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    status
        .lines()
        .find_map(|l| l.strip_prefix(key))
        .and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok())
        .map_or(0.0, |kb| kb / 1024.0)
}

/// The smallest of some values; infinite of none.
pub(crate) fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The middle of some values; NaN of none.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    match n {
        0 => f64::NAN,
        _ => 0.5 * (values[(n - 1) / 2] + values[n / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_an_even_number_lies_between() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(vec![]).is_nan());
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn children_take_time() {
        let before = children_cpu();
        let script = "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done";
        let status = std::process::Command::new("sh").args(["-c", script]).status().unwrap();
        assert!(status.success() && children_cpu() > before);
    }

    #[test]
    fn work_takes_time() {
        let (sum, time) = timed(|| (0..3_000_000u64).map(std::hint::black_box).sum::<u64>());
        assert!(sum > 0 && time > 0.0);
    }
}
