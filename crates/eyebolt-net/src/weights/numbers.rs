//! Little-endian numbers to 32 bits and back.

use crate::Error;
use half::{bf16, f16};
use safetensors::Dtype;

/// The numbers of a tensor, if its type is a floating-point one of 16 or 32 bits.
pub fn decode(dtype: Dtype, bytes: &[u8]) -> Option<Vec<f32>> {
    let pairs = || bytes.as_chunks::<2>().0.iter().copied();
    Some(match dtype {
        Dtype::F32 => bytes.as_chunks::<4>().0.iter().map(|&b| f32::from_le_bytes(b)).collect(),
        Dtype::F16 => pairs().map(|b| f16::from_le_bytes(b).to_f32()).collect(),
        Dtype::BF16 => pairs().map(|b| bf16::from_le_bytes(b).to_f32()).collect(),
        _ => return None,
    })
}

/// Numbers of 32 bits as bytes.
pub fn encode(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// Numbers of 32 bits as those of 16 that are nearest; beyond 65 504 they are infinite.
pub fn encode_half(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| f16::from_f32(*value).to_le_bytes()).collect()
}

/// That no value of a tensor is NaN or infinite.
pub fn check_finite(file: &str, name: &str, values: &[f32]) -> Result<(), Error> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(at) => Err(Error::file(file, name, format!("value {at} is {}", values[at]))),
        None => Ok(()),
    }
}
