//! Functions that the standard wants to be there, of what this unit has not. They say so, and fail.

use super::{Pointer, Status, with};
use crate::error::Error;
use std::ffi::{c_char, c_void};

/// A function with an instance and so many arguments, and why it is not supported.
macro_rules! unsupported {
    ($($why:literal: $($name:ident($($argument:ty),*))*;)*) => {
        $($(
            #[unsafe(no_mangle)]
            unsafe extern "C" fn $name(instance: Pointer $(, _: $argument)*) -> Status {
                with(instance, stringify!($name), |_| Err(Error::new(concat!("not supported: ", $why))))
            }
        )*)*
    };
}

/// A list of value references.
type References = *const u32;
/// A list of values to be filled, or to be read.
type Values = *const c_void;
/// Lists of texts.
type Texts = *const *const c_char;

unsupported! {
    "all numbers of this unit are Float64, all truth values outputs":
        fmi3GetFloat32(References, usize, Values, usize)
        fmi3GetInt8(References, usize, Values, usize)
        fmi3GetUInt8(References, usize, Values, usize)
        fmi3GetInt16(References, usize, Values, usize)
        fmi3GetUInt16(References, usize, Values, usize)
        fmi3GetInt32(References, usize, Values, usize)
        fmi3GetUInt32(References, usize, Values, usize)
        fmi3GetInt64(References, usize, Values, usize)
        fmi3GetUInt64(References, usize, Values, usize)
        fmi3GetString(References, usize, Texts, usize)
        fmi3GetBinary(References, usize, Values, Values, usize)
        fmi3GetClock(References, usize, Values)
        fmi3SetFloat32(References, usize, Values, usize)
        fmi3SetInt8(References, usize, Values, usize)
        fmi3SetUInt8(References, usize, Values, usize)
        fmi3SetInt16(References, usize, Values, usize)
        fmi3SetUInt16(References, usize, Values, usize)
        fmi3SetInt32(References, usize, Values, usize)
        fmi3SetUInt32(References, usize, Values, usize)
        fmi3SetInt64(References, usize, Values, usize)
        fmi3SetUInt64(References, usize, Values, usize)
        fmi3SetBoolean(References, usize, Values, usize)
        fmi3SetString(References, usize, Texts, usize)
        fmi3SetBinary(References, usize, Values, Values, usize)
        fmi3SetClock(References, usize, Values)
        fmi2GetInteger(References, usize, Values)
        fmi2GetString(References, usize, Values)
        fmi2SetInteger(References, usize, Values)
        fmi2SetBoolean(References, usize, Values)
        fmi2SetString(References, usize, Texts);
    "no variable depends on elements of others":
        fmi3GetNumberOfVariableDependencies(u32, *mut usize)
        fmi3GetVariableDependencies(u32, *mut usize, *mut u32, *mut usize, *mut i32, usize);
    "states are kept in memory, not as bytes":
        fmi3SerializedFMUStateSize(Pointer, *mut usize)
        fmi3SerializeFMUState(Pointer, *mut u8, usize)
        fmi3DeserializeFMUState(*const u8, usize, *mut Pointer)
        fmi2SerializedFMUstateSize(Pointer, *mut usize)
        fmi2SerializeFMUstate(Pointer, *mut c_char, usize)
        fmi2DeSerializeFMUstate(*const c_char, usize, *mut Pointer);
    "impacts have no derivatives":
        fmi3GetDirectionalDerivative(References, usize, References, usize, *const f64, usize, *mut f64, usize)
        fmi3GetAdjointDerivative(References, usize, References, usize, *const f64, usize, *mut f64, usize)
        fmi3GetOutputDerivatives(References, usize, *const i32, *mut f64, usize)
        fmi2GetDirectionalDerivative(References, usize, References, usize, *const f64, *mut f64)
        fmi2GetRealOutputDerivatives(References, usize, *const i32, *mut f64)
        fmi2SetRealInputDerivatives(References, usize, *const i32, *const f64);
    "this unit has no structural parameters":
        fmi3EnterConfigurationMode()
        fmi3ExitConfigurationMode();
    "this unit has neither events nor clocks":
        fmi3EnterEventMode()
        fmi3EnterStepMode()
        fmi3GetIntervalDecimal(References, usize, *mut f64, *mut i32)
        fmi3GetIntervalFraction(References, usize, *mut u64, *mut u64, *mut i32)
        fmi3GetShiftDecimal(References, usize, *mut f64)
        fmi3GetShiftFraction(References, usize, *mut u64, *mut u64)
        fmi3SetIntervalDecimal(References, usize, *const f64)
        fmi3SetIntervalFraction(References, usize, *const u64, *const u64)
        fmi3SetShiftDecimal(References, usize, *const f64)
        fmi3SetShiftFraction(References, usize, *const u64, *const u64)
        fmi3EvaluateDiscreteStates()
        fmi3UpdateDiscreteStates(*mut bool, *mut bool, *mut bool, *mut bool, *mut bool, *mut f64)
        fmi3ActivateModelPartition(u32, f64);
    "this unit is for co-simulation alone":
        fmi3EnterContinuousTimeMode()
        fmi3CompletedIntegratorStep(bool, *mut bool, *mut bool)
        fmi3SetTime(f64)
        fmi3SetContinuousStates(*const f64, usize)
        fmi3GetContinuousStateDerivatives(*mut f64, usize)
        fmi3GetEventIndicators(*mut f64, usize)
        fmi3GetContinuousStates(*mut f64, usize)
        fmi3GetNominalsOfContinuousStates(*mut f64, usize)
        fmi3GetNumberOfEventIndicators(*mut usize)
        fmi3GetNumberOfContinuousStates(*mut usize);
    "a step is done when the call returns":
        fmi2CancelStep()
        fmi2GetStatus(i32, *mut i32)
        fmi2GetRealStatus(i32, *mut f64)
        fmi2GetIntegerStatus(i32, *mut i32)
        fmi2GetBooleanStatus(i32, *mut i32)
        fmi2GetStringStatus(i32, *mut *const c_char);
}
