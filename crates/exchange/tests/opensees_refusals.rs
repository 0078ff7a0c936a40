//! Scripts of OpenSees that are wrong: an error at its line and column, or a loss by name, and never a panic.

use std::path::Path;
use trilith_exchange::opensees::{self, NoAnswers};
use trilith_exchange::{Import, Options, Refused};

/// Few commands, so that loops end soon.
const BUDGET: u64 = 20_000;

fn read_in(text: &[u8], folder: Option<&Path>) -> Result<Import, Refused> {
    let options = Options {
        path: "model.tcl".into(),
        folder: folder.map(Into::into),
        budget: BUDGET,
        ..Options::default()
    };
    opensees::import(text, &options, &NoAnswers)
}

fn read(text: &str) -> Import {
    read_in(text.as_bytes(), None).unwrap_or_else(|e| panic!("{e}"))
}

const HEAD: &str = "model BasicBuilder -ndm 2 -ndf 3\nnode 1 0 0\nnode 2 0 3\n";

/// The first error of a script behind two nodes, at a line and column of what is added.
fn refused(text: &str, line: usize, column: usize, words: &str) {
    let all = match read_in(format!("{HEAD}{text}").as_bytes(), None) {
        Ok(import) => panic!("{words}: let through\n{}", import.report.text()),
        Err(refused) => refused.0,
    };
    let e = &all[0];
    let said = format!("{e}");
    assert!(said.contains(words), "{words} in\n{said}");
    // Which command of a loop was the last one is not said.
    let at = (e.line(), if column == 0 { 0 } else { e.column() });
    assert_eq!(at, (line + 3, column), "{said}");
}

#[test]
fn what_is_wrong_is_told_at_its_place() {
    for (text, line, column, words) in [
        ("nodes 3 0 0", 1, 1, "there is no command `nodes`"),
        ("nod 3 0 0", 1, 1, "did you mean `node`?"),
        ("node 3 0", 1, 1, "`node` without a coordinate"),
        ("node 3 0 x", 1, 10, "`x` is no number"),
        ("node 3.5 0 0", 1, 6, "`3.5` is no whole number"),
        ("node 2 0 0", 1, 6, "there are two nodes 2"),
        ("node 3 0 0 0", 1, 12, "more than 2 coordinates"),
        ("fix 9 1 1 1", 1, 5, "there is no node 9"),
        ("fix 1 1 1", 1, 1, "`fix` without 0 or 1"),
        ("fix 1 1 1 1 1", 1, 13, "more than 3 degrees of freedom"),
        ("mass 2 1 1", 1, 8, "2 masses for 3 degrees of freedom"),
        ("set a 1\nfoo {", 2, 5, "a brace that does not close"),
        ("set a \"b", 1, 7, "quotes that do not end"),
        ("set a [expr 1", 1, 7, "a bracket that does not close"),
        ("set a {b}c", 1, 7, "right behind a closing brace"),
        ("expr {1 +}", 1, 1, "ends too early"),
        ("expr {1/0}", 1, 1, "a division by zero"),
        ("expr {sqrt(-1)}", 1, 1, "without a finite value"),
        ("expr {rand()}", 1, 1, "a random number"),
        ("expr {$b + 1}", 1, 1, "there is no variable `b`"),
        ("if {1} {\n  node 4 0 y\n}", 2, 12, "`y` is no number"),
        ("foreach i {3 4} {\n  node $i 0 $i$i\n  node $i 0 z\n}", 3, 8, "there are two nodes 3"),
        ("proc p {a} { node $a 0 0 }\np", 2, 1, "`p` without its argument `a`"),
        ("proc p {} {\n  mass 7 1 1 1\n}\np", 2, 8, "there is no node 7"),
        ("while {1} { set a 1 }", 1, 0, "does not end"),
        ("while 1 {}", 1, 0, "does not end"),
        ("for {set i 0} {$i < 10} {} { incr j }", 1, 0, "does not end"),
        ("proc p {} { p }\np", 1, 0, "nested too deeply"),
        ("set a x; while 1 { append a $a }", 1, 0, "does not end"),
        ("set a [string repeat abc 99999999]", 1, 8, "more than 50 MB"),
        ("exec rm -rf /", 1, 1, "`exec` is not executed"),
        ("socket localhost 80", 1, 1, "`socket` is not executed"),
        ("set f [open record.txt r]", 1, 8, "`open` is not executed"),
        ("file delete model.tcl", 1, 1, "`file delete` is not executed"),
        ("source other.tcl", 1, 8, "there is no folder"),
        ("element truss 1 1 2 0.1 5", 1, 25, "there is no material 5"),
        ("element elasticBeamColumn 1 1 2 0.1 2e11 1e-4 8", 1, 47, "there is no transformation 8"),
        ("load 2 1 0 0", 1, 1, "a load outside of a pattern"),
        ("pattern Plain 1 Linear {\n  load 2 1 0\n}", 2, 3, "`load` without a force"),
        ("eigen 2", 1, 1, "the model has no modes yet"),
        ("analysis Static\nset d [expr 2*[nodeDisp 2 1]]", 2, 8, "is no number"),
        (
            "uniaxialMaterial Elastic 1 2e5\nuniaxialMaterial Elastic 1 2e5",
            2,
            26,
            "two materials 1",
        ),
    ] {
        refused(text, line, column, words);
    }
    let said = read_in(b"set a 1\n", None).unwrap_err().to_string();
    assert!(said.contains("makes no nodes"), "{said}");
    let said = read_in(b"node 1 0 0\n", None).unwrap_err().to_string();
    assert!(said.contains("model.tcl:1:1") && said.contains("there is no model yet"), "{said}");
}

/// Each expression of few parentheses, and a hundred of them wait for the next: no stack holds that.
#[test]
fn expressions_that_wait_for_each_other_come_to_an_end() {
    let (open, close) = ("(".repeat(95), ")".repeat(95));
    let said = read_in(format!("proc p {{}} {{ expr {{{open}[p]{close}}} }}\np").as_bytes(), None);
    let said = said.unwrap_err().to_string();
    assert!(said.contains("an expression that is nested too deeply"), "{said}");
    // Nothing is left of those that have ended, well or not; and what comes to an end may go deep.
    let script = format!(
        "proc f {{n}} {{\n  if {{$n < 2}} {{ return 1.0 }}\n  return [expr {{$n*[f [expr {{$n - 1}}]]}}]\n}}\n\
         for {{set i 0}} {{$i < 50}} {{incr i}} {{\n  catch {{expr {{{open}nothing{close}}}}}\n  \
         expr {{{open}1{close}}}\n}}\nnode 3 [expr {{[f 80]*1e-118}}] x"
    );
    refused(&script, 9, 31, "`x` is no number");
}

#[test]
fn files_are_read_within_the_folder_alone_and_none_reads_itself() {
    let all = tempfile::tempdir().unwrap();
    let folder = all.path().join("models");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(all.path().join("outside.tcl"), "node 3 0 0\n").unwrap();
    std::fs::write(folder.join("part.tcl"), "node 3 0 6\nnode 4 0 q\n").unwrap();
    std::fs::write(folder.join("again.tcl"), "source again.tcl\n").unwrap();
    std::fs::write(folder.join("record.txt"), "0 1\n2 x\n").unwrap();
    for (text, words) in [
        ("source ../outside.tcl", "lies outside of the folder"),
        ("source nowhere.tcl", "`nowhere.tcl` cannot be read"),
        ("source again.tcl", "again.tcl:1:8"),
        ("source part.tcl", "part.tcl:2:10"),
        ("timeSeries Path 1 -dt 0.1 -filePath record.txt", "`record.txt` line 2: `x` is no number"),
        ("timeSeries Path 1 -dt 0.1 -filePath ../outside.tcl", "lies outside of the folder"),
    ] {
        let text = format!("{HEAD}{text}\n");
        let said = read_in(text.as_bytes(), Some(&folder)).unwrap_err().to_string();
        assert!(said.contains(words), "{words} in\n{said}");
    }
}

#[test]
fn what_has_no_counterpart_is_named_with_its_line() {
    let import = read(&format!(
        "{HEAD}fix 1 1 1 1\nuniaxialMaterial Elastic 1 1e6\nuniaxialMaterial Steel02 2 1 2 3\n\
         element zeroLength 1 1 2 -mat 1 -dir 1\nelement forceBeamColumn 2 1 2 5 1\n\
         element zeroLength 3 1 2 -mat 2 -dir 1 -frobnicate\nputs \"done\"\nregion 1 -ele 1\n"
    ));
    let text = import.report.text();
    for words in [
        "uniaxialMaterial Steel02  1  this material has no counterpart (line 6)",
        "element forceBeamColumn   1  this element has no counterpart (line 8)",
        "its material in direction 1 was lost (line 9)",
        "the argument `-frobnicate` is not read (line 9)",
        "region                    1  this command has no counterpart (line 11)",
        "puts  1  what a script prints is left out",
        "a script has no units",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    assert_eq!(import.report.losses(), 5, "{text}");
}

#[test]
fn the_language_is_that_of_tcl() {
    let import = read(
        "model BasicBuilder -ndm 2 -ndf 3\n\
         # a comment that goes on \\\n   node 99 9 9\n\
         proc place {tag {x 0.5} args} { node $tag $x [llength $args]; return [expr {$tag*2}] }\n\
         set doubled [place 1]; place 2 7 a b\n\
         array set heights {low 1.5 high 4}\n\
         foreach {name height} [array get heights] { node [incr doubled] 0 $height }\n\
         set text [format \"%05.2f|%-4s|%d\" 3.14159 ab 7]\n\
         if {$text eq \"03.14|ab  |7\"} { node 10 1 1 } else { error $text }\n\
         set i 0\nwhile 1 { incr i; if {$i == 2} continue; if {$i > 4} break; node [expr 20+$i] $i 0 }\n\
         proc up {name} { upvar $name v; set v [expr {$v + 1}] }\nup i\nnode 30 $i [expr {7/2}]\n\
         node 31 [lindex [lrange {a 1 2 3} 1 end] end-1] [expr {-7/2}] ;# behind a semicolon\n\
         switch -glob abc { x* { node 40 0 0 } a* { node 41 0 0 } default { node 42 0 0 } }\n\
         node 50 [expr {1 ? 2 : [nowhere]}] [expr {3 > 2 && \"a\" != \"b\"}]\n\
         node 51 [expr {2**3**2}] [string length [string map {a bb} banana]]\n\
         if {[catch {expr {1/0}} said]} { node 52 0 0 }\n\
         uniaxialMaterial Elastic 1 5\nelement zeroLength 1 1 2 -mat 1 -dir 1\n",
    );
    let nodes: Vec<(&str, f64, f64)> =
        import.draft.nodes.iter().map(|(n, at)| (n.as_str(), at[0], at[1])).collect();
    let expected = [
        ("1", 0.5, 0.0),
        ("2", 7.0, 2.0),
        ("3", 0.0, 4.0),
        ("4", 0.0, 1.5),
        ("10", 1.0, 1.0),
        ("21", 1.0, 0.0),
        ("23", 3.0, 0.0),
        ("24", 4.0, 0.0),
        ("30", 6.0, 3.0),
        ("31", 2.0, -4.0),
        ("41", 0.0, 0.0),
        ("50", 2.0, 1.0),
        ("51", 512.0, 9.0),
        ("52", 0.0, 0.0),
    ];
    assert_eq!(nodes, expected);
}

/// A sequence of numbers that is the same at every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) as usize) % n.max(1)
    }
}

#[test]
fn scripts_that_are_spoiled_at_random_end_without_a_panic() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/opensees");
    let mut scripts: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    scripts.sort();
    let texts: Vec<Vec<u8>> = scripts.iter().map(|p| std::fs::read(p).unwrap()).collect();
    let pieces: [&[u8]; 20] = [
        b"{",
        b"}",
        b"[",
        b"]",
        b"\"",
        b"\\",
        b"$",
        b"$x(",
        b"-1",
        b"1e308",
        b"0",
        b"\n",
        b";",
        b" ",
        b"while 1 {}",
        b"9999999999999999999",
        b"\xc3\xa9",
        b"expr {",
        b"node",
        b"nan",
    ];
    let mut dice = Dice(7);
    let mut read = 0;
    for round in 0..1500 {
        let mut text = texts[round % texts.len()].clone();
        for _ in 0..=dice.below(3) {
            let at = dice.below(text.len());
            let to = (at + dice.below(12)).min(text.len());
            match dice.below(4) {
                0 => _ = text.drain(at..to),
                1 => _ = text.splice(at..at, pieces[dice.below(pieces.len())].iter().copied()),
                2 => {
                    let copy: Vec<u8> = text[at..to].to_vec();
                    let there = dice.below(text.len());
                    text.splice(there..there, copy);
                }
                _ => text.truncate(at.max(1)),
            }
        }
        match read_in(&text, None) {
            Ok(import) => {
                let _ = import.report.text();
                let _ = import.draft.to_ron();
                read += 1;
            }
            Err(refused) => assert!(!refused.0.is_empty() && refused.0[0].line() > 0),
        }
    }
    // Most of what is left out or copied is a comment, a number, an output.
    assert!(read > 100, "{read}");
}
