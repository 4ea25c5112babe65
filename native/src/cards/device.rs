//! Which device.

use std::fmt;
use std::str::FromStr;

/// How a device is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Api {
    /// OpenCL: cards of all makers, and processors.
    OpenCl,
    /// CUDA: NVIDIA's cards.
    Cuda,
}

impl fmt::Display for Api {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OpenCl => "opencl",
            Self::Cuda => "cuda",
        })
    }
}

/// A device by its number: `opencl`, `opencl:1`, `cuda:0`.
///
/// OpenCL's are counted over all platforms, cards before processors; CUDA's as CUDA counts them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Device {
    /// How it is reached.
    pub api: Api,
    /// Its number, from 0.
    pub number: usize,
}

impl FromStr for Device {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, number) = match text.split_once(':') {
            Some((name, number)) => (name, Some(number)),
            None => (text, None),
        };
        let api = match name {
            "opencl" => Api::OpenCl,
            "cuda" => Api::Cuda,
            _ => return Err("write opencl or cuda, with a number if you like: opencl:1".into()),
        };
        let number = number.map_or(Ok(0), str::parse).map_err(|_| {
            format!("after {name}: stands the number of a device, from 0, as in {name}:1")
        })?;
        Ok(Self { api, number })
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.api, self.number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_named_by_their_number() {
        let device = |text: &str| text.parse::<Device>();
        assert_eq!(device("opencl"), Ok(Device { api: Api::OpenCl, number: 0 }));
        assert_eq!(device("cuda:3"), Ok(Device { api: Api::Cuda, number: 3 }));
        assert_eq!(device("cuda:3").map(|one| one.to_string()), Ok("cuda:3".to_owned()));
        for wrong in ["", "vulkan", "cuda:", "cuda:-1", "opencl:1:2", "OpenCL"] {
            assert!(device(wrong).is_err(), "{wrong}");
        }
    }
}
