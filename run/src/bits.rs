//! Numbers written as their bits, so that files give back NaN and every digit: `#[serde(with = "coadjoint_run::bits")]`.

use coadjoint_codegen::step::Drift;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::DeserializeOwned};

/// Values made of numbers.
pub trait Bits: Sized {
    /// The same with bits for numbers.
    type Raw: Serialize + DeserializeOwned;

    /// The bits of a value.
    fn raw(&self) -> Self::Raw;

    /// The value of these bits.
    fn of(raw: Self::Raw) -> Self;
}

impl Bits for f64 {
    type Raw = u64;

    fn raw(&self) -> u64 {
        self.to_bits()
    }

    fn of(raw: u64) -> Self {
        Self::from_bits(raw)
    }
}

impl<T: Bits> Bits for Option<T> {
    type Raw = Option<T::Raw>;

    fn raw(&self) -> Self::Raw {
        self.as_ref().map(T::raw)
    }

    fn of(raw: Self::Raw) -> Self {
        raw.map(T::of)
    }
}

impl<T: Bits> Bits for Vec<T> {
    type Raw = Vec<T::Raw>;

    fn raw(&self) -> Self::Raw {
        self.iter().map(T::raw).collect()
    }

    fn of(raw: Self::Raw) -> Self {
        raw.into_iter().map(T::of).collect()
    }
}

impl<T: Bits> Bits for [T; 3] {
    type Raw = [T::Raw; 3];

    fn raw(&self) -> Self::Raw {
        self.each_ref().map(T::raw)
    }

    fn of(raw: Self::Raw) -> Self {
        raw.map(T::of)
    }
}

impl Bits for Drift {
    type Raw = [u64; 3];

    fn raw(&self) -> Self::Raw {
        self.numbers().raw()
    }

    fn of(raw: Self::Raw) -> Self {
        Self::of_numbers(Bits::of(raw))
    }
}

/// Writes a value.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<T: Bits, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
    value.raw().serialize(to)
}

/// Reads a value.
///
/// # Errors
/// Those of the deserializer.
pub fn deserialize<'de, T: Bits, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
    T::Raw::deserialize(from).map(T::of)
}
