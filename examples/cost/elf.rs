//! The size of what a program loads, from its ELF sections.

/// The bytes of code and constants; of a file in another format all bytes.
pub(crate) fn loaded(file: &[u8]) -> u64 {
    sections(file).unwrap_or(file.len() as u64)
}

/// The sum over the sections that are loaded and stored in the file; `None` unless it is a
/// little-endian ELF of 64 bits.
fn sections(file: &[u8]) -> Option<u64> {
    const SHT_NOBITS: u64 = 8;
    const SHF_ALLOC: u64 = 2;
    if !file.starts_with(b"\x7fELF\x02\x01") {
        return None;
    }
    let [table, size, count] = [(0x28, 8), (0x3a, 2), (0x3c, 2)].map(|(at, len)| number(file, at, len));
    let (table, size) = (usize::try_from(table?).ok()?, usize::try_from(size?).ok()?);
    (0..usize::try_from(count?).ok()?)
        .map(|section| {
            let header = file.get(table + section * size..)?;
            let [kind, flags, bytes] = [(4, 4), (8, 8), (32, 8)].map(|(at, len)| number(header, at, len));
            Some(if kind? != SHT_NOBITS && flags? & SHF_ALLOC != 0 { bytes? } else { 0 })
        })
        .sum()
}

/// The number of `len` bytes at an offset.
fn number(bytes: &[u8], at: usize, len: usize) -> Option<u64> {
    Some(bytes.get(at..at + len)?.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte)))
}
