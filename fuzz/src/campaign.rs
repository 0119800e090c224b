//! Campaigns: a reader, its corpus, and mutated copies of it.

use crate::mutation::Mutation;
use crate::watch::{Cost, measured};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use std::{env, fs};

/// One campaign runs at a time, because memory is counted for the whole process.
static ALONE: Mutex<()> = Mutex::new(());

/// The largest number of inputs that are kept for their new outcomes.
const MAX_KEPT: usize = 4000;
/// The largest number of different failures to look for.
const MAX_FAILURES: usize = 20;

/// Result of reading an input.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The input was accepted, and the result is sound.
    Accepted {
        /// Size of the result in bytes, where it may be much larger than the input, as the pixels of a picture are.
        kept: usize,
    },
    /// The input was refused with this error.
    Refused(String),
    /// The input was accepted but should not have been.
    Unsound(String),
}

impl Outcome {
    /// Accepted, with a result that is not larger than the input.
    pub const ACCEPTED: Self = Self::Accepted { kept: 0 };
}

/// A reader, its corpus, and the number of mutated copies to try.
#[derive(Debug)]
pub struct Campaign<'a> {
    /// Name of the campaign and of its folder of the corpus.
    pub name: &'a str,
    /// Inputs in addition to those of the folder.
    pub seeds: Vec<Vec<u8>>,
    /// Inputs that are read but not mutated, because they take too long to be read often.
    pub unchanged: Vec<Vec<u8>>,
    /// Words that mean something to a reader of text; empty for other files.
    pub words: &'a [&'a str],
    /// Corrects the checksums of a mutated file, so that the code behind their checks is reached too.
    pub repair: fn(&[u8]) -> Vec<u8>,
    /// Number of mutated copies to try when no time is set.
    pub executions: u64,
}

/// Counts of a campaign so far.
#[derive(Debug, Default)]
struct Tally {
    executions: u64,
    accepted: u64,
    outcomes: HashSet<String>,
    slowest: Cost,
    largest: Cost,
    /// The file that shows each failure, by the description of the failure.
    failures: BTreeMap<String, PathBuf>,
}

impl<'a> Campaign<'a> {
    /// A campaign without seeds beyond those of the folder.
    pub fn new(name: &'a str, executions: u64) -> Self {
        Self {
            name,
            seeds: Vec::new(),
            unchanged: Vec::new(),
            words: &[],
            repair: <[u8]>::to_vec,
            executions,
        }
    }

    /// Runs the corpus and mutated copies of it.
    ///
    /// # Panics
    /// When an input fails; all failures are listed. Also when no input was accepted or none was refused: the campaign then proves nothing.
    pub fn run(&self, read: impl Fn(&[u8]) -> Outcome) {
        let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = env::temp_dir().join("pellicle-fuzz");
        fs::create_dir_all(&folder).expect("the temporary folder can be written");
        let mut tally = Tally::default();
        let mut inputs = self.seeds.clone();
        inputs.extend(of_folder(&corpus(self.name)));
        for input in self.unchanged.iter().chain(&inputs) {
            self.execute(&folder, &mut tally, &read, input);
        }
        // Mutating a broken corpus would say nothing new.
        if tally.failures.is_empty() {
            self.change(&folder, &mut tally, &read, inputs);
        }
        self.report(&tally);
    }

    fn change(
        &self,
        folder: &Path,
        tally: &mut Tally,
        read: &impl Fn(&[u8]) -> Outcome,
        mut inputs: Vec<Vec<u8>>,
    ) {
        let seconds: Option<f64> = number_of("PELLICLE_FUZZ_SECONDS");
        let seed = number_of("PELLICLE_FUZZ_SEED").unwrap_or(1);
        let start = Instant::now();
        for number in 0_u64.. {
            let is_over = match seconds {
                Some(seconds) => start.elapsed() > Duration::from_secs_f64(seconds),
                None => number >= self.executions,
            };
            if is_over || tally.failures.len() >= MAX_FAILURES || inputs.is_empty() {
                break;
            }
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(number);
            let mut pick = || &inputs[random.next_u64() as usize % inputs.len()];
            let (input, other) = (pick(), pick());
            let words = self.words;
            let mut mutation = Mutation {
                random: &mut random,
                words,
                other,
            };
            let changed = mutation.of(input);
            let is_repaired = random.next_u32() % 4 != 0;
            let changed = if is_repaired {
                (self.repair)(&changed)
            } else {
                changed
            };
            let is_new = self.execute(folder, tally, read, &changed);
            if is_new && inputs.len() < MAX_KEPT {
                inputs.push(changed);
            }
        }
    }

    /// Reads an input and returns whether its outcome is new.
    fn execute(
        &self,
        folder: &Path,
        tally: &mut Tally,
        read: &impl Fn(&[u8]) -> Outcome,
        input: &[u8],
    ) -> bool {
        fs::write(folder.join(format!("{}.running", self.name)), input)
            .expect("the temporary folder can be written");
        let (mut result, mut cost) = measured(|| read(input));
        // A machine that was busy with something else is not a fault of the reader.
        for _ in 0..2 {
            if cost.check(input.len(), kept(&result)).is_err() {
                let (again, other) = measured(|| read(input));
                result = again;
                cost.time = cost.time.min(other.time);
                cost.bytes = cost.bytes.min(other.bytes);
            }
        }
        tally.count(cost);
        let wrong = match &result {
            Err(panic) => Some(panic.clone()),
            Ok(Outcome::Unsound(what)) => Some(format!("is unsound: {what}")),
            Ok(_) => cost.check(input.len(), kept(&result)).err(),
        };
        if let Some(wrong) = wrong {
            let file = folder.join(format!("{}.failed.{}", self.name, tally.failures.len()));
            let is_new = !tally
                .failures
                .keys()
                .any(|known| words_of(known) == words_of(&wrong));
            if is_new {
                fs::write(&file, input).expect("the temporary folder can be written");
                tally.failures.insert(wrong, file);
            }
            return false;
        }
        let outcome = if let Ok(Outcome::Refused(error)) = result {
            words_of(&error)
        } else {
            tally.accepted += 1;
            String::new()
        };
        tally.outcomes.insert(outcome)
    }

    fn report(&self, tally: &Tally) {
        println!(
            "{}: {} executions, {} accepted, {} outcomes; at most {:.3} s and {:.1} MB",
            self.name,
            tally.executions,
            tally.accepted,
            tally.outcomes.len(),
            tally.slowest.time.as_secs_f64(),
            tally.largest.bytes as f64 / f64::from(1 << 20),
        );
        let failures = tally.failures.iter();
        let failures = failures.map(|(wrong, file)| format!("\n{}: {wrong}", file.display()));
        let failures: String = failures.collect();
        assert!(failures.is_empty(), "the reader of {}{failures}", self.name);
        let is_refused = tally.accepted < tally.executions;
        assert!(
            tally.accepted > 0 && is_refused,
            "{}: some inputs must be accepted and some refused",
            self.name
        );
    }
}

impl Tally {
    fn count(&mut self, cost: Cost) {
        self.executions += 1;
        if cost.time > self.slowest.time {
            self.slowest = cost;
        }
        if cost.bytes > self.largest.bytes {
            self.largest = cost;
        }
    }
}

fn kept(result: &Result<Outcome, String>) -> usize {
    match result {
        Ok(Outcome::Accepted { kept }) => *kept,
        _ => 0,
    }
}

/// The words of an error without its numbers and quotes, which differ from input to input.
fn words_of(error: &str) -> String {
    let mut words = String::new();
    let mut is_quoted = false;
    for c in error.chars() {
        match c {
            '"' | '`' => is_quoted = !is_quoted,
            _ if !is_quoted && c.is_alphabetic() && words.len() < 160 => words.push(c),
            _ => {}
        }
    }
    words
}

fn number_of<T: std::str::FromStr>(variable: &str) -> Option<T> {
    let text = env::var(variable).ok()?;
    let number = text.parse();
    Some(number.unwrap_or_else(|_| panic!("{variable} is {text:?}, not a number")))
}

fn corpus(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("corpus")
        .join(name)
}

/// The files of a folder, sorted by name; empty if there is no folder.
fn of_folder(folder: &Path) -> Vec<Vec<u8>> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let read = |path: PathBuf| fs::read(path).expect("the corpus can be read");
    paths.into_iter().map(read).collect()
}
