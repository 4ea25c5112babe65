//! Devices of CUDA.
//!
//! The type system cannot check that starting a kernel is sound. The reasons stand at the call: the kernel is printed
//! from the [`Kernel`](coadjoint_program::Kernel) whose sizes the arrays have, and gets its arguments with the types of its
//! text. Reads and writes are checked by their lengths.
#![allow(unsafe_code)]

use std::sync::Arc;

use coadjoint_program::Kernel;
use coadjoint_program::print::{DeviceLanguage, KERNEL_NAME, device_unit};
use cudarc::driver::sys::{self, CUresult};
use cudarc::driver::{
    CudaContext, CudaFunction, CudaSlice, CudaStream, DriverError, LaunchConfig, PushKernelArg,
};
use cudarc::nvrtc::Ptx;

use super::machine::{Array, Arrays, Call, Fault, Machine, Opened, Room};
use super::nvrtc;
use super::{Device, DeviceError};

/// Threads of a block.
const BLOCK: u32 = 128;

/// Opens a device and builds the kernel there.
pub(crate) fn open(device: Device, kernel: &Kernel, slots: &[f64]) -> Result<Opened, DeviceError> {
    // SAFETY: it only tries to load the library. (Calling it otherwise would end the program.)
    if !unsafe { sys::is_culib_present() } {
        return Err(DeviceError::NoLibrary {
            library: "CUDA driver (libcuda)",
            install: "NVIDIA's driver",
        });
    }
    if !nvrtc::is_there() {
        return Err(DeviceError::NoLibrary {
            library: "CUDA compiler (libnvrtc)",
            install: "the CUDA toolkit, or nvidia-cuda-nvrtc-cu12 for Python with its folder in LD_LIBRARY_PATH",
        });
    }
    let call = Call { device };
    let count = match CudaContext::device_count() {
        Ok(count) => usize::try_from(count).unwrap_or(0),
        Err(DriverError(CUresult::CUDA_ERROR_NO_DEVICE)) => 0,
        Err(error) => return Err(call.failed("counted its devices", &error)),
    };
    if device.number >= count {
        let found = match count {
            0 => "CUDA finds none".to_owned(),
            1 => "CUDA finds one, cuda:0".to_owned(),
            count => format!("CUDA finds {count}, from cuda:0 on"),
        };
        return Err(DeviceError::NoDevice { device, found });
    }
    let context = call.done("was opened", CudaContext::new(device.number))?;
    let name = call.done("was asked for its name", context.name())?;
    let (major, minor) = call.done("was asked for its kind", context.compute_capability())?;
    let memory = context.mem_get_info().map_or(u64::MAX, |(free, _)| free as u64);
    let text = device_unit(kernel, slots, DeviceLanguage::Cuda, "Written by coadjoint.");
    let compiled = nvrtc::compile_text(&text, &format!("sm_{major}{minor}"))
        .map_err(|log| DeviceError::Build { device, name: name.clone(), log })?;
    let module = context.load_module(Ptx::from_binary(compiled.code));
    let module = call.done("loaded the kernel", module)?;
    let function = call.done("looked for the kernel", module.load_function(KERNEL_NAME))?;
    let stream = context.default_stream();
    let machine = Cuda { call, stream, function, arrays: Arrays::default() };
    // Not all of the free memory is ours.
    let memory = (memory / 10 * 9, u64::MAX);
    Ok(Opened { machine: Box::new(machine), name, processor: false, memory })
}

impl Fault for DriverError {
    fn is_short(&self) -> bool {
        self.0 == CUresult::CUDA_ERROR_OUT_OF_MEMORY
    }
}

/// An opened device with the kernel.
struct Cuda {
    call: Call,
    stream: Arc<CudaStream>,
    function: CudaFunction,
    arrays: Arrays<CudaSlice<u8>>,
}

impl Machine for Cuda {
    fn reserve(&mut self, bytes: [usize; 3]) -> Result<(), Room> {
        let (call, stream) = (self.call, &self.stream);
        self.arrays
            .reserve(bytes, |bytes| call.room("made room", stream.alloc_zeros::<u8>(bytes)))?;
        self.call.room("made room", self.stream.synchronize())
    }

    fn write(&mut self, array: Array, first: usize, bytes: &[u8]) -> Result<(), Room> {
        let to = self.arrays.get(array, first, bytes.len()).ok_or(Room::Short)?;
        let mut to = to.slice_mut(first..first + bytes.len());
        self.call.room("took numbers", self.stream.memcpy_htod(bytes, &mut to))?;
        self.call.room("took numbers", self.stream.synchronize())
    }

    fn read(&mut self, array: Array, first: usize, bytes: &mut [u8]) -> Result<(), Room> {
        let from = self.arrays.get(array, first, bytes.len()).ok_or(Room::Short)?;
        let from = from.slice(first..first + bytes.len());
        self.call.room("gave numbers", self.stream.memcpy_dtoh(&from, bytes))?;
        self.call.room("gave numbers", self.stream.synchronize())
    }

    fn launch(&mut self, rows: u64, target: u64) -> Result<(), Room> {
        let [states, done, status] = self.arrays.all()?;
        let blocks = u32::try_from(rows.div_ceil(u64::from(BLOCK))).unwrap_or(u32::MAX);
        let shape = LaunchConfig {
            grid_dim: (blocks, 1, 1),
            block_dim: (BLOCK, 1, 1),
            shared_mem_bytes: 0,
        };
        let mut start = self.stream.launch_builder(&self.function);
        start.arg(states).arg(done).arg(status).arg(&rows).arg(&target);
        // SAFETY: the kernel takes three arrays and two numbers of 64 bits; the arrays are made for this number of rows, and
        // threads beyond do nothing.
        let started = unsafe { start.launch(shape) };
        self.call.room("started the kernel", started)?;
        self.call.room("ran the kernel", self.stream.synchronize())
    }
}
