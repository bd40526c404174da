//! What reading costs: CPU time of the thread, which other programs on a busy machine do not
//! lengthen.

/// CPU time in s that this thread has used; 0 where the system does not say, so that nothing is
/// compared.
fn cpu_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split(' ').next().and_then(|field| field.parse().ok());
    nanoseconds.unwrap_or(0.0) * 1e-9
}

/// Reads an input of 1/10 of `size` and one of that size: the larger takes ten times as long if the
/// time is in proportion, a hundred times if it is a square.
pub(crate) fn takes_time_in_proportion(size: usize, read: impl Fn(usize)) {
    let seconds = |size: usize| {
        let begin = cpu_seconds();
        read(size);
        cpu_seconds() - begin
    };
    seconds(size / 10); // what happens once only
    let (small, large) = (seconds(size / 10), seconds(size));
    assert!(large < 40.0 * small.max(2e-3), "{small} s for {}, {large} s for {size}", size / 10);
}
