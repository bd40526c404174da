//! SHA-256 of files that are read and written.

use std::io::{self, Write};

use sha2::{Digest, Sha256};

/// The SHA-256 of some bytes, in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Passes bytes on and hashes them on the way.
pub struct Hashing<W> {
    inner: W,
    hash: Sha256,
}

impl<W: Write> Hashing<W> {
    /// Nothing is written yet.
    pub fn new(inner: W) -> Self {
        Self { inner, hash: Sha256::new() }
    }

    /// The stream.
    pub fn inner(&mut self) -> &mut W {
        &mut self.inner
    }

    /// Hashes bytes that are already in the stream.
    pub fn holds(&mut self, bytes: &[u8]) {
        self.hash.update(bytes);
    }

    /// The stream, and the SHA-256 of everything written.
    pub fn finish(self) -> (W, String) {
        (self.inner, hexadecimal(&self.hash.finalize()))
    }
}

impl<W: Write> Write for Hashing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::{Hashing, sha256};

    /// FIPS 180-2, appendix B.1.
    const ABC: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

    #[test]
    fn the_published_example() {
        assert_eq!(sha256(b"abc"), ABC);
    }

    #[test]
    fn a_stream_is_hashed_as_it_passes() {
        let mut stream = Hashing::new(Vec::new());
        stream.write_all(b"a").unwrap();
        stream.write_all(b"bc").unwrap();
        assert_eq!(stream.finish(), (b"abc".to_vec(), ABC.to_owned()));
    }
}
