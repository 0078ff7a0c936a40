//! Storeys, points in plan, and the joints where both meet.
//!
//! A joint exists where an object stands at a point in a storey: `1@Story2` is point 1 in Story2. The third coordinate of a
//! point is how far it lies below its storey.

use super::words::{File, Thing};
use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

/// A joint: its point and its storey, by their numbers.
type Key = (usize, usize);

/// The plan of a building.
pub struct Plan<'a> {
    /// Names and elevations from the top down.
    stories: Vec<(&'a str, f64)>,
    /// Numbers of points and their places: x, y, depth below the storey.
    numbers: HashMap<&'a str, usize>,
    points: Vec<(&'a str, [f64; 3])>,
    made: RefCell<BTreeSet<Key>>,
}

impl<'a> Plan<'a> {
    pub fn new(file: &File<'a>) -> Self {
        let mut it = Self {
            stories: stories(file),
            numbers: HashMap::new(),
            points: Vec::new(),
            made: RefCell::default(),
        };
        for thing in file.each("POINT COORDINATES", "POINT", 1) {
            let name = thing.names[0];
            let (Some(x), Some(y)) = (thing.number_at(1), thing.number_at(2)) else {
                thing.wrong("a point needs its X and Y", "POINT \"1\"  0  6.5");
                continue;
            };
            let depth = thing.at(3).filter(|t| !t.is_word()).map(|_| thing.number_at(3));
            if it.numbers.insert(name, it.points.len()).is_some() {
                thing.wrong(
                    &format!("there are two points \"{name}\""),
                    "every point has a name of its own",
                );
            }
            it.points.push((name, [x, y, depth.flatten().unwrap_or(0.0)]));
        }
        it
    }

    /// The number of a storey, from the top.
    pub fn story(&self, thing: &Thing<'_>, name: &str) -> Option<usize> {
        let found = self.stories.iter().position(|(n, _)| *n == name);
        if found.is_none() {
            let message = format!("there is no storey \"{name}\"");
            thing.wrong(&message, "they stand in STORIES - IN SEQUENCE FROM TOP");
        }
        found
    }

    /// The storey so many below another.
    pub fn below(&self, thing: &Thing<'_>, story: usize, count: usize) -> Option<usize> {
        let found = story.checked_add(count).filter(|s| *s < self.stories.len());
        if found.is_none() {
            let message = format!("there are not {count} storeys below {}", self.stories[story].0);
            thing.wrong(&message, "the number behind the points of a line counts storeys");
        }
        found
    }

    /// The number of a point.
    pub fn point(&self, thing: &Thing<'_>, name: &str) -> Option<usize> {
        let found = self.numbers.get(name).copied();
        if found.is_none() {
            let message = format!("there is no point \"{name}\"");
            thing.wrong(&message, "points stand in the section POINT COORDINATES");
        }
        found
    }

    /// A joint's name; it is there from now on.
    pub fn make(&self, at: Key) -> String {
        self.made.borrow_mut().insert(at);
        self.name(at)
    }

    /// True where something stands at a joint.
    pub fn is_made(&self, at: Key) -> bool {
        self.made.borrow().contains(&at)
    }

    pub fn name(&self, (point, story): Key) -> String {
        format!("{}@{}", self.points[point].0, self.stories[story].0)
    }

    pub fn at(&self, (point, story): Key) -> [f64; 3] {
        let [x, y, depth] = self.points[point].1;
        [x, y, self.stories[story].1 - depth]
    }

    /// Joints of a storey.
    pub fn of_story(&self, story: usize) -> Vec<Key> {
        self.made.borrow().iter().filter(|at| at.1 == story).copied().collect()
    }

    pub fn story_name(&self, story: usize) -> &'a str {
        self.stories[story].0
    }

    /// Writes the joints.
    pub fn write(&self, file: &File<'a>) {
        for at in self.made.borrow().iter() {
            let [x, y, z] = self.at(*at);
            let row = file.row("JOINT COORDINATES", &(0..0)).with("Joint", &self.name(*at));
            row.with("XorR", x).with("Y", y).with("Z", z).put();
        }
    }
}

/// Names and elevations; the lowest storey is the base.
fn stories<'a>(file: &File<'a>) -> Vec<(&'a str, f64)> {
    let things = file.each("STORIES", "STORY", 1);
    let mut out: Vec<(&str, f64)> = Vec::new();
    let mut below = 0.0;
    for (i, thing) in things.iter().enumerate().rev() {
        let name = thing.names[0];
        let (height, elevation) = (thing.number("HEIGHT"), thing.number("ELEV"));
        let base = i + 1 == things.len();
        let z = match (height, elevation) {
            (Some(height), None) if !base => below + height,
            (_, Some(z)) => z,
            (_, None) if base => 0.0,
            _ => {
                thing.wrong(&format!("the storey \"{name}\" has no height"), "HEIGHT 3.2");
                below
            }
        };
        if height.is_some_and(|h| h < 0.0) {
            thing.wrong_at("HEIGHT", "the height of a storey is below zero", "");
        }
        if out.iter().any(|(n, _)| *n == name) {
            let help = "every storey has a name of its own";
            thing.wrong(&format!("there are two storeys \"{name}\""), help);
        }
        below = z;
        out.push((name, z));
    }
    out.reverse();
    out
}
