//! Random numbers that are the same everywhere: SplitMix64 (Steele, Lea and Flood 2014).

#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The seed of the numbers to come.
    pub fn state(&self) -> u64 {
        self.0
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }

    pub fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    /// −1, one in this number of times; else 1.
    pub fn sign_one_in(&mut self, count: usize) -> f64 {
        if self.one_in(count) { -1.0 } else { 1.0 }
    }

    /// A vector of about unit length; now and then along an axis or in a coordinate plane.
    pub fn direction(&mut self, dim: usize) -> Vec<f64> {
        loop {
            let mut v: Vec<f64> = (0..dim).map(|_| self.between(-1.0, 1.0)).collect();
            match self.below(12) {
                0 => {
                    let keep = self.below(dim);
                    v.iter_mut()
                        .enumerate()
                        .filter(|(i, _)| *i != keep)
                        .for_each(|(_, v)| *v = 0.0);
                }
                1 => {
                    let at = self.below(dim);
                    v[at] = 0.0;
                }
                // Nearly along an axis, where motions are unstable.
                2 => {
                    let keep = self.below(dim);
                    let small = 10_f64.powf(self.between(-9.0, -1.0));
                    v.iter_mut()
                        .enumerate()
                        .filter(|(i, _)| *i != keep)
                        .for_each(|(_, v)| *v *= small);
                }
                _ => {}
            }
            let length = v.iter().map(|v| v * v).sum::<f64>().sqrt();
            if length > 0.05 {
                v.iter_mut().for_each(|v| *v /= length);
                return v;
            }
        }
    }
}
