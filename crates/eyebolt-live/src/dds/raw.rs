//! Messages as bytes.

use rustdds::RepresentationIdentifier;
use rustdds::bytes::Bytes;
use rustdds::no_key::{Decode, DefaultDecoder, DeserializerAdapter, SerializerAdapter};
use std::convert::Infallible;

/// A message with the four bytes before it that tell its byte order, as bags have it.
pub(super) struct Raw(pub(super) Vec<u8>);

/// Hands bytes through.
pub(super) struct AsBytes;

/// Bytes before a message that tell how it is written.
const ENCAPSULATION: usize = 4;

/// What ROS 2 writes, in both orders of bytes. Version 2 of CDR is not among it.
const ENCODINGS: &[RepresentationIdentifier] =
    &[RepresentationIdentifier::CDR_LE, RepresentationIdentifier::CDR_BE];

impl DeserializerAdapter<Raw> for AsBytes {
    type Error = Infallible;
    type Decoded = Raw;

    fn supported_encodings() -> &'static [RepresentationIdentifier] {
        ENCODINGS
    }

    fn transform_decoded(decoded: Raw) -> Raw {
        decoded
    }
}

impl DefaultDecoder<Raw> for AsBytes {
    type Decoder = Copying;
    const DECODER: Copying = Copying;
}

/// Copies the bytes of a message behind those that tell how it is written.
#[derive(Clone)]
pub(super) struct Copying;

impl Decode<'_, Raw> for Copying {
    type Error = Infallible;

    fn decode_bytes(
        self,
        input_bytes: &[u8],
        encoding: RepresentationIdentifier,
    ) -> Result<Raw, Infallible> {
        let little_endian = encoding == RepresentationIdentifier::CDR_LE;
        let mut bytes = Vec::with_capacity(ENCAPSULATION + input_bytes.len());
        bytes.extend([0, u8::from(little_endian), 0, 0]);
        bytes.extend_from_slice(input_bytes);
        Ok(Raw(bytes))
    }
}

impl SerializerAdapter<Raw> for AsBytes {
    type Error = Infallible;

    fn output_encoding() -> RepresentationIdentifier {
        // What we write is little-endian.
        RepresentationIdentifier::CDR_LE
    }

    fn to_bytes(value: &Raw) -> Result<Bytes, Infallible> {
        Ok(Bytes::copy_from_slice(value.0.get(ENCAPSULATION..).unwrap_or_default()))
    }
}
