//! Devices of OpenCL.
//!
//! The type system cannot check the calls that pass memory to the device. They are sound for these reasons:
//! reads and writes wait until they are done and never pass the end of an array, which is asked for its bytes before; the
//! kernel is printed from the [`Kernel`](coadjoint_program::Kernel) whose sizes the arrays have, gets its arguments with the
//! types of its text, and is waited for.
#![allow(unsafe_code)]

use std::ptr;
use std::sync::{Mutex, PoisonError};

use coadjoint_program::print::{DeviceLanguage, KERNEL_NAME, device_unit};
use coadjoint_program::{Kernel, Precision};
use opencl3::command_queue::CommandQueue;
use opencl3::context::Context;
use opencl3::device::Device as Found;
use opencl3::device::{
    CL_DEVICE_TYPE_ALL, CL_DEVICE_TYPE_GPU, CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT,
};
use opencl3::error_codes::{
    CL_INVALID_BUFFER_SIZE, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_HOST_MEMORY,
    CL_OUT_OF_RESOURCES, ClError, DLOPEN_RUNTIME_LOAD_FAILED,
};
use opencl3::kernel::Kernel as Compiled;
use opencl3::memory::{Buffer, CL_MEM_READ_WRITE, ClMem};
use opencl3::platform::get_platforms;
use opencl3::program::Program;
use opencl3::types::{CL_BLOCKING, cl_mem};

use super::machine::{Array, Arrays, Call, Fault, Machine, Opened, Room};
use crate::cards::{Device, DeviceError};
use crate::error::first_errors;

/// Threads of a group, where the device takes as many: the number that cards run together. Left to itself, pocl takes thousands,
/// whose numbers are more than a stack holds.
const GROUP: usize = 64;

/// Opens a device and builds the kernel there.
pub(crate) fn open(device: Device, kernel: &Kernel, slots: &[f64]) -> Result<Opened, DeviceError> {
    let found = find(device)?;
    let call = Call { device };
    let name = call.done("was asked for its name", found.name())?.trim().to_owned();
    if kernel.precision() == Precision::Double && !found.double_fp_config().is_ok_and(|it| it != 0)
    {
        return Err(DeviceError::NoDouble { device, name });
    }
    let context = call.done("made a context", Context::from_device(&found))?;
    // The newer call is missing where there is OpenCL 1.2 alone.
    #[allow(deprecated)]
    let queue = CommandQueue::create_default(&context, 0);
    let queue = call.done("made a queue", queue)?;
    let text = device_unit(kernel, slots, DeviceLanguage::OpenCl, "Written by coadjoint.");
    let program = Program::create_from_source(&context, &text);
    let mut program = call.done("read the kernel", program)?;
    if let Err(error) = program.build(&[found.id()], &options(&found, kernel.precision())) {
        let log = program.get_build_log(found.id()).unwrap_or_default();
        let log = if log.trim().is_empty() { error.to_string() } else { first_errors(&log) };
        return Err(DeviceError::Build { device, name, log });
    }
    let compiled = call.done("made the kernel", Compiled::create(&program, KERNEL_NAME))?;
    let memory = (found.global_mem_size().unwrap_or(0), found.max_mem_alloc_size().unwrap_or(0));
    // A driver that does not know leaves it to the allocations.
    let memory = [memory.0, memory.1].map(|bytes| if bytes == 0 { u64::MAX } else { bytes });
    let processor = found.dev_type().is_ok_and(|it| it & CL_DEVICE_TYPE_GPU == 0);
    let arrays = Arrays::default();
    let group = compiled.get_work_group_size(found.id()).map_or(GROUP, |most| most.clamp(1, GROUP));
    let machine = OpenCl { call, queue, compiled, group, arrays, context, _program: program };
    // Not all of the memory is ours.
    let memory = (memory[0] / 4 * 3, memory[1]);
    Ok(Opened { machine: Box::new(machine), name, processor, memory })
}

/// Divisions and roots of 32 bits as IEEE 754 has them, where the device can. pocl, where it optimises, fuses products with
/// sums although the text forbids it.
fn options(found: &Found, precision: Precision) -> String {
    let rounds = || {
        let config = found.single_fp_config();
        config.is_ok_and(|config| config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT != 0)
    };
    let mut options = "-cl-std=CL1.2".to_owned();
    if precision == Precision::Single && rounds() {
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    }
    if found.version().is_ok_and(|version| version.to_lowercase().contains("pocl")) {
        options += " -cl-opt-disable";
    }
    options
}

/// Held while devices are enumerated: pocl initialises on the first call, and not safely from two threads at once.
static LOOKING: Mutex<()> = Mutex::new(());

/// The device of this number: cards first, platform by platform.
fn find(device: Device) -> Result<Found, DeviceError> {
    let _one_at_a_time = LOOKING.lock().unwrap_or_else(PoisonError::into_inner);
    let platforms = match get_platforms() {
        Ok(platforms) => platforms,
        Err(ClError(DLOPEN_RUNTIME_LOAD_FAILED)) => {
            return Err(DeviceError::NoLibrary {
                library: "OpenCL library",
                install: "the driver of the card, or ocl-icd-libopencl1 and pocl-opencl-icd for the processor",
            });
        }
        // The loader without a platform says so by an error.
        Err(_) => Vec::new(),
    };
    let mut found: Vec<Found> = Vec::new();
    for platform in &platforms {
        // A platform without devices says so by an error.
        found
            .extend(platform.get_devices(CL_DEVICE_TYPE_ALL).into_iter().flatten().map(Found::new));
    }
    found.sort_by_key(|one| !one.dev_type().is_ok_and(|it| it & CL_DEVICE_TYPE_GPU != 0));
    let named = |one: (usize, &Found)| {
        format!("opencl:{} is {}", one.0, one.1.name().unwrap_or_default().trim())
    };
    let list: Vec<String> = found.iter().enumerate().map(named).collect();
    found.into_iter().nth(device.number).ok_or_else(|| DeviceError::NoDevice {
        device,
        found: if list.is_empty() { "OpenCL finds none".into() } else { list.join(", ") },
    })
}

impl Fault for ClError {
    fn is_short(&self) -> bool {
        let short = [
            CL_MEM_OBJECT_ALLOCATION_FAILURE,
            CL_OUT_OF_RESOURCES,
            CL_OUT_OF_HOST_MEMORY,
            CL_INVALID_BUFFER_SIZE,
        ];
        short.contains(&self.0)
    }
}

/// An opened device with the kernel.
struct OpenCl {
    call: Call,
    queue: CommandQueue,
    compiled: Compiled,
    /// Threads of a group.
    group: usize,
    arrays: Arrays<Buffer<u8>>,
    context: Context,
    _program: Program,
}

impl Machine for OpenCl {
    fn reserve(&mut self, bytes: [usize; 3]) -> Result<(), Room> {
        let (call, context) = (self.call, &self.context);
        self.arrays.reserve(bytes, |bytes| {
            // SAFETY: no memory of ours is handed over.
            let buffer =
                unsafe { Buffer::<u8>::create(context, CL_MEM_READ_WRITE, bytes, ptr::null_mut()) };
            call.room("made room", buffer)
        })
    }

    fn write(&mut self, array: Array, first: usize, bytes: &[u8]) -> Result<(), Room> {
        let to = self.arrays.get(array, first, bytes.len()).ok_or(Room::Short)?;
        // SAFETY: the array has these bytes, and the call waits until they are read.
        let written =
            unsafe { self.queue.enqueue_write_buffer(to, CL_BLOCKING, first, bytes, &[]) };
        self.call.room("took numbers", written).map(|_| ())
    }

    fn read(&mut self, array: Array, first: usize, bytes: &mut [u8]) -> Result<(), Room> {
        let from = self.arrays.get(array, first, bytes.len()).ok_or(Room::Short)?;
        // SAFETY: the array has these bytes, and the call waits until they are written.
        let read = unsafe { self.queue.enqueue_read_buffer(from, CL_BLOCKING, first, bytes, &[]) };
        self.call.room("gave numbers", read).map(|_| ())
    }

    fn launch(&mut self, rows: u64, target: u64) -> Result<(), Room> {
        let arrays = self.arrays.all()?;
        let kernel = &self.compiled;
        let set = || -> Result<(), ClError> {
            for (place, buffer) in (0_u32..).zip(arrays.iter()) {
                let memory: cl_mem = buffer.get();
                // SAFETY: the kernel's first three arguments are arrays.
                unsafe { kernel.set_arg(place, &memory) }?;
            }
            for (place, number) in [(3, rows), (4, target)] {
                // SAFETY: the kernel's last two arguments are numbers of 64 bits.
                unsafe { kernel.set_arg(place, &number) }?;
            }
            Ok(())
        };
        self.call.room("took arguments", set())?;
        let threads = (rows as usize).next_multiple_of(self.group);
        // SAFETY: the arrays are made for this number of rows; threads beyond do nothing; the call below waits.
        let started = unsafe {
            self.queue.enqueue_nd_range_kernel(
                kernel.get(),
                1,
                ptr::null(),
                [threads].as_ptr(),
                [self.group].as_ptr(),
                &[],
            )
        };
        self.call.room("started the kernel", started)?;
        self.call.room("ran the kernel", self.queue.finish())
    }
}
