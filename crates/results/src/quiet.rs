//! A file that stays silent once it could not be written.

use std::io::{ErrorKind, Result, Seek, SeekFrom, Write};

/// Passes everything on until the first error. What comes after it is lost: the error has been told, and what a writer
/// around this one still puts out when it is given up would only fail again.
#[derive(Debug)]
pub(crate) struct Quiet<W> {
    inner: W,
    failed: bool,
    /// Where the next byte goes, and the end of the file: both go on after an error.
    at: u64,
    end: u64,
}

impl<W: Write + Seek> Quiet<W> {
    /// Around a file that is still empty.
    pub fn new(inner: W) -> Self {
        Self { inner, failed: false, at: 0, end: 0 }
    }

    fn told<T>(&mut self, done: Result<T>) -> Result<T> {
        // An interrupted call is made again.
        self.failed = matches!(&done, Err(e) if e.kind() != ErrorKind::Interrupted);
        done
    }

    fn goes_to(&mut self, at: u64) {
        self.at = at;
        self.end = self.end.max(at);
    }
}

impl<W: Write + Seek> Write for Quiet<W> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let count = if self.failed {
            bytes.len()
        } else {
            let done = self.inner.write(bytes);
            self.told(done)?
        };
        self.goes_to(self.at + count as u64);
        Ok(count)
    }

    fn flush(&mut self) -> Result<()> {
        if self.failed {
            return Ok(());
        }
        let done = self.inner.flush();
        self.told(done)
    }
}

impl<W: Write + Seek> Seek for Quiet<W> {
    fn seek(&mut self, to: SeekFrom) -> Result<u64> {
        let at = if self.failed {
            let at = match to {
                SeekFrom::Start(at) => Some(at),
                SeekFrom::Current(by) => self.at.checked_add_signed(by),
                SeekFrom::End(by) => self.end.checked_add_signed(by),
            };
            at.ok_or(ErrorKind::InvalidInput)?
        } else {
            let done = self.inner.seek(to);
            self.told(done)?
        };
        self.at = at;
        Ok(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, Error};
    use zip::write::SimpleFileOptions;

    /// A disk with so much room.
    struct Full(Cursor<Vec<u8>>, u64);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> Result<usize> {
            match self.0.position() + bytes.len() as u64 > self.1 {
                true => Err(ErrorKind::StorageFull.into()),
                false => self.0.write(bytes),
            }
        }
        fn flush(&mut self) -> Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, to: SeekFrom) -> Result<u64> {
            self.0.seek(to)
        }
    }

    /// Bytes that do not get smaller.
    fn noise() -> Vec<u8> {
        let next = |s: &mut u64| {
            *s = s.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Some((*s >> 56) as u8)
        };
        std::iter::repeat_n((), 1 << 20).scan(1_u64, |seed, ()| next(seed)).collect()
    }

    /// The error is told once; a writer of archives that is dropped then ends its archive and says nothing on stderr.
    #[test]
    fn an_archive_on_a_full_disk_is_given_up_in_silence() {
        let disk = Full(Cursor::new(Vec::new()), 10_000);
        let mut zip = zip::ZipWriter::new(Quiet::new(disk));
        zip.start_file("a.npy", SimpleFileOptions::default()).unwrap();
        assert_eq!(zip.write_all(&noise()).unwrap_err().kind(), ErrorKind::StorageFull);
        // What dropping it does.
        zip.finish().unwrap();
    }

    #[test]
    fn the_first_error_is_told_and_the_place_goes_on() {
        let mut file = Quiet::new(Full(Cursor::new(Vec::new()), 5));
        file.write_all(b"abcd").unwrap();
        file.seek(SeekFrom::Start(1)).unwrap();
        let told: Error = file.write_all(b"bcdef").unwrap_err();
        assert_eq!(told.kind(), ErrorKind::StorageFull);
        file.write_all(b"bcdef").unwrap();
        file.flush().unwrap();
        assert_eq!(file.stream_position().unwrap(), 6);
        assert_eq!(file.seek(SeekFrom::End(-2)).unwrap(), 4);
        assert!(file.seek(SeekFrom::Current(-9)).is_err());
    }
}
