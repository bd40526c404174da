//! One of several parts of a sweep.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// The k-th of n parts, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Its number, from 1.
    pub k: u64,
    /// Number of parts.
    pub n: u64,
}

impl Shard {
    /// The cases of this part, out of `cases`, counted from 0.
    pub fn range(self, cases: u64) -> Range<u64> {
        let at = |k: u64| {
            let place = u128::from(cases) * u128::from(k) / u128::from(self.n);
            u64::try_from(place).unwrap_or(cases)
        };
        at(self.k - 1)..at(self.k)
    }

    /// The folder of the part.
    pub fn folder(self) -> String {
        format!("part-{}-of-{}", self.k, self.n)
    }

    /// The part of the folder with this name.
    pub fn of_folder(name: &str) -> Option<Self> {
        let (k, n) = name.strip_prefix("part-")?.split_once("-of-")?;
        let shard = format!("{k}/{n}").parse().ok()?;
        (name == Self::folder(shard)).then_some(shard)
    }

    /// The part that the scheduler asks for: task of a Slurm job array.
    fn of_scheduler(read: &dyn Fn(&str) -> Option<String>) -> Result<Self, String> {
        let number = |name: &str| {
            let text = read(name).ok_or_else(|| {
                format!("{name} is not set: --shard auto is for the tasks of a Slurm job array")
            })?;
            text.trim().parse::<u64>().map_err(|_| format!("{name} is `{text}`, not a number"))
        };
        let (task, count) = (number("SLURM_ARRAY_TASK_ID")?, number("SLURM_ARRAY_TASK_COUNT")?);
        let (first, last) = (number("SLURM_ARRAY_TASK_MIN")?, number("SLURM_ARRAY_TASK_MAX")?);
        // tasks of a job that is sent again may be some of them only
        if last + 1 != first + count {
            return Err(format!(
                "the array has {count} tasks from {first} to {last}: number them without gaps, or \
                 write --shard K/N"
            ));
        }
        Self::of(task + 1 - first.min(task + 1), count)
    }

    fn of(k: u64, n: u64) -> Result<Self, String> {
        match k >= 1 && k <= n {
            true => Ok(Self { k, n }),
            false => Err(format!("there is no part {k} of {n}: parts are counted from 1")),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.k, self.n)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Self::of_scheduler(&|name| std::env::var(name).ok());
        }
        let parts = text.split_once('/');
        let numbers =
            parts.and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
        let (k, n) = numbers.ok_or("write the part and the number of parts: 3/20")?;
        Self::of(k, n)
    }
}

#[cfg(test)]
mod tests {
    use super::Shard;

    #[test]
    fn parts_lie_side_by_side_and_are_equally_long() {
        for cases in [0, 1, 7, 100, 1_000_000_000] {
            for n in [1, 2, 3, 7, 64] {
                let parts: Vec<_> = (1..=n).map(|k| Shard { k, n }.range(cases)).collect();
                assert_eq!((parts[0].start, parts[parts.len() - 1].end), (0, cases));
                assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start));
                let lengths: Vec<u64> = parts.iter().map(|part| part.end - part.start).collect();
                assert!(lengths.iter().max().unwrap() - lengths.iter().min().unwrap() <= 1);
            }
        }
    }

    #[test]
    fn a_scheduler_is_asked() {
        let slurm =
            |id: &'static str, count: &'static str, min: &'static str, max: &'static str| {
                move |name: &str| {
                    Some(match name {
                        "SLURM_ARRAY_TASK_ID" => id.to_owned(),
                        "SLURM_ARRAY_TASK_COUNT" => count.to_owned(),
                        "SLURM_ARRAY_TASK_MIN" => min.to_owned(),
                        _ => max.to_owned(),
                    })
                }
            };
        assert_eq!(Shard::of_scheduler(&slurm("3", "20", "1", "20")), Ok(Shard { k: 3, n: 20 }));
        assert_eq!(Shard::of_scheduler(&slurm("0", "20", "0", "19")), Ok(Shard { k: 1, n: 20 }));
        assert!(Shard::of_scheduler(&slurm("7", "2", "3", "7")).is_err());
        assert!(Shard::of_scheduler(&|_| None).is_err());
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
        assert_eq!(Shard::of_folder("part-3-of-20"), Some(Shard { k: 3, n: 20 }));
        assert_eq!(Shard::of_folder("part-03-of-20"), None);
    }
}
