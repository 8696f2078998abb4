//! Many image files at once: their headers first, then the greatest first, several at a time.

use super::{Decoded, Header, decode, header};
use crate::load::Budget;
use rayon::prelude::*;
use std::borrow::Cow;
use std::cmp::Reverse;

/// An image file whose header has been read.
pub(in crate::load) struct Encoded<'a> {
    name: String,
    bytes: Cow<'a, [u8]>,
    header: Header,
}

impl<'a> Encoded<'a> {
    /// Reads the header; the ending of `name` may tell the kind.
    ///
    /// # Errors
    ///
    /// One line that says what is wrong, without the image's name.
    pub(in crate::load) fn new(name: String, bytes: Cow<'a, [u8]>) -> Result<Encoded<'a>, String> {
        let header = header(&name, &bytes)?;
        Ok(Encoded {
            name,
            bytes,
            header,
        })
    }
}

/// Decodes all, with memory from the budget, which the earlier are given first. Each comes back under its key, in the
/// keys' order.
pub(in crate::load) fn decode_all<K: Ord + Send>(
    encoded: Vec<(K, Result<Encoded, String>)>,
    budget: &Budget,
) -> Vec<(K, Result<Decoded, String>)> {
    let mut decoded: Vec<(K, Result<Decoded, String>)> = Vec::new();
    let mut ready: Vec<(K, Encoded)> = Vec::new();
    for (key, found) in encoded {
        let taken = found.and_then(|encoded| {
            encoded.header.take(budget)?;
            Ok(encoded)
        });
        match taken {
            Ok(encoded) => ready.push((key, encoded)),
            Err(problem) => decoded.push((key, Err(problem))),
        }
    }
    ready.sort_by_key(|(_, encoded)| Reverse(encoded.header.bytes_to_decode()));
    // What takes more than a thread's part of the memory that is left is decoded alone.
    let part = budget.left() / rayon::current_num_threads() as u64;
    let small = ready.partition_point(|(_, e)| e.header.bytes_to_decode() > part);
    let rest = ready.split_off(small);
    let decode = |(key, encoded): (K, Encoded)| (key, decode(&encoded.name, &encoded.bytes));
    budget.decode(|| {
        decoded.extend(ready.into_iter().map(decode));
        // One thread takes the next when it is done with one: what is greatest is never last.
        decoded.par_extend(rest.into_iter().par_bridge().map(decode));
    });
    decoded.sort_by(|(one, _), (other, _)| one.cmp(other));
    decoded
}
