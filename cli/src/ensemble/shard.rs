//! A share of an ensemble for one job of an array.

use std::ops::Range;
use std::str::FromStr;

/// Share number `index` of `count`, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    index: u64,
    count: u64,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(i, n)| (i.trim().parse(), n.trim().parse()));
        match numbers {
            Some((Ok(index), Ok(count))) if 1 <= index && index <= count => {
                Ok(Self { index, count })
            }
            Some((Ok(index), Ok(count))) => Err(format!(
                "there is no share {index} of {count}: shares are counted from 1, as in 1/{n} … \
                 {n}/{n}",
                n = u64::max(count, 1)
            )),
            _ => Err("write i/n, for example 3/8".into()),
        }
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl Shard {
    /// All of it.
    pub(crate) const WHOLE: Self = Self { index: 1, count: 1 };

    /// Its rows of `total`, counted from 0. Shares are consecutive, differ by one row at most, and
    /// together are everything.
    pub(crate) fn rows(self, total: u64) -> Range<u64> {
        let end =
            |index: u64| (u128::from(total) * u128::from(index) / u128::from(self.count)) as u64;
        end(self.index - 1)..end(self.index)
    }
}
