//! Mutated copies of inputs.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

/// The longest input that mutations produce.
const MAX_BYTES: usize = 200_000;

/// Numbers at which arithmetic, ranges and parsers break.
const NUMBERS: [&str; 30] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e-6",
    "1e-300",
    "-1e-300",
    "5e-324",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e999",
    "1e9",
    "1e6",
    "1e3",
    "65535",
    "65536",
    "2147483647",
    "-2147483648",
    "4294967296",
    "9223372036854775807",
    "18446744073709551616",
    "99999999999999999999999999",
    "0xff",
    "nan",
    "inf",
    "-inf",
    "1,5",
];

/// Integers at which sizes and offsets break.
const INTEGERS: [i64; 16] = [
    0,
    1,
    -1,
    2,
    127,
    128,
    255,
    256,
    32_767,
    65_535,
    65_536,
    1 << 24,
    (1 << 31) - 1,
    -(1 << 31),
    1 << 32,
    i64::MAX,
];

/// Mutates one input; `random` decides what is changed and how.
pub(crate) struct Mutation<'a> {
    pub(crate) random: &'a mut ChaCha8Rng,
    /// Words that mean something to the reader.
    pub(crate) words: &'a [&'a str],
    /// Another input, pieces of which may be inserted.
    pub(crate) other: &'a [u8],
}

impl Mutation<'_> {
    /// A random number below `count`; 0 when `count` is 0.
    fn below(&mut self, count: usize) -> usize {
        let number = self.random.next_u64() as usize;
        number.checked_rem(count).unwrap_or(0)
    }

    /// A random range of `bytes`; short ones are more likely.
    fn piece(&mut self, bytes: &[u8]) -> (usize, usize) {
        let longest = [1, 4, 16, 256, bytes.len()][self.below(5)];
        let start = self.below(bytes.len() + 1);
        let end = (start + self.below(longest + 1)).min(bytes.len());
        (start, end)
    }

    /// A mutated copy of `input`: mostly with one change, sometimes with several.
    pub(crate) fn of(&mut self, input: &[u8]) -> Vec<u8> {
        let mut bytes = input.to_vec();
        for _ in 0..[1, 1, 1, 2, 3, 8][self.below(6)] {
            self.change(&mut bytes);
            bytes.truncate(MAX_BYTES);
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>) {
        let is_text = !self.words.is_empty();
        match self.below(if is_text { 16 } else { 11 }) {
            0 => self.flip_a_bit(bytes),
            1 => self.set_a_byte(bytes),
            2 => {
                let (start, end) = self.piece(bytes);
                bytes.drain(start..end);
            }
            3 => {
                let end = self.below(bytes.len() + 1);
                bytes.truncate(end);
            }
            4 => self.repeat(bytes),
            5 => self.splice(bytes),
            6 => {
                let random: Vec<u8> = (0..=self.below(8))
                    .map(|_| self.random.next_u32() as u8)
                    .collect();
                self.put(bytes, &random);
            }
            7..=9 => self.set_an_integer(bytes),
            10 => self.swap_lines(bytes),
            11 | 12 => self.set_a_number(bytes),
            13 => self.set_a_token(bytes),
            _ => {
                let word = self.word();
                self.put(bytes, word.as_bytes());
            }
        }
    }

    fn word(&mut self) -> String {
        let words = self.words;
        let word = words.get(self.below(words.len())).copied();
        word.unwrap_or_default().to_owned()
    }

    fn put(&mut self, bytes: &mut Vec<u8>, piece: &[u8]) {
        let at = self.below(bytes.len() + 1);
        let end = at + [0, piece.len()][self.below(2)];
        bytes.splice(at..end.min(bytes.len()), piece.iter().copied());
    }

    fn flip_a_bit(&mut self, bytes: &mut [u8]) {
        let (at, bit) = (self.below(bytes.len()), self.below(8));
        if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1 << bit;
        }
    }

    fn set_a_byte(&mut self, bytes: &mut [u8]) {
        let value = [0, 1, 0x7f, 0x80, 0xff, self.random.next_u32() as u8][self.below(6)];
        let at = self.below(bytes.len());
        if let Some(byte) = bytes.get_mut(at) {
            *byte = value;
        }
    }

    /// Repeats a piece once or many times.
    fn repeat(&mut self, bytes: &mut Vec<u8>) {
        let (start, end) = self.piece(bytes);
        let most = MAX_BYTES / (end - start).max(1);
        let times = [1, 2, 10, 300, 20_000][self.below(5)].min(most);
        let piece = bytes[start..end].repeat(times);
        bytes.splice(end..end, piece);
    }

    fn splice(&mut self, bytes: &mut Vec<u8>) {
        let other = self.other;
        let (start, end) = self.piece(other);
        self.put(bytes, &other[start..end]);
    }

    fn set_an_integer(&mut self, bytes: &mut [u8]) {
        let value = INTEGERS[self.below(INTEGERS.len())];
        let width = [1, 2, 4, 8][self.below(4)];
        let mut piece = value.to_le_bytes()[..width].to_vec();
        if self.below(2) == 0 {
            piece.reverse();
        }
        let at = self.below(bytes.len());
        for (byte, new) in bytes.iter_mut().skip(at).zip(piece) {
            *byte = new;
        }
    }

    fn swap_lines(&mut self, bytes: &mut Vec<u8>) {
        let mut lines: Vec<Vec<u8>> = bytes.split(|&b| b == b'\n').map(<[u8]>::to_vec).collect();
        let (a, b) = (self.below(lines.len()), self.below(lines.len()));
        lines.swap(a, b);
        *bytes = lines.join(&b'\n');
    }

    /// Replaces a number by another one.
    fn set_a_number(&mut self, bytes: &mut Vec<u8>) {
        let number = NUMBERS[self.below(NUMBERS.len())];
        let is_part = |b: u8| b.is_ascii_digit() || b == b'.';
        self.set_a_run(bytes, is_part, number);
    }

    /// Replaces a word by one of the reader's words.
    fn set_a_token(&mut self, bytes: &mut Vec<u8>) {
        let word = self.word();
        let is_part = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'.';
        self.set_a_run(bytes, is_part, &word);
    }

    fn set_a_run(&mut self, bytes: &mut Vec<u8>, is_part: impl Fn(u8) -> bool, new: &str) {
        let from = self.below(bytes.len());
        let Some(length) = bytes[from..].iter().position(|&b| is_part(b)) else {
            return;
        };
        let is_outside = |&b: &u8| !is_part(b);
        let start = bytes[..from + length]
            .iter()
            .rposition(is_outside)
            .map_or(0, |at| at + 1);
        let end = bytes[from + length..]
            .iter()
            .position(is_outside)
            .map_or(bytes.len(), |more| from + length + more);
        bytes.splice(start..end, new.bytes());
    }
}
