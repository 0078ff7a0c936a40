//! What a shell and `man` are told: every command, and nothing that is not there.

mod common;

use common::trilith;
use std::path::Path;

#[test]
fn a_shell_completes_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let (status, text, _) = trilith(Path::new("."), &["completions", shell]);
        assert_eq!(status, 0, "{shell}");
        for word in ["run", "sweep", "checkpoint-at", "completions"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
    let (status, _, said) = trilith(Path::new("."), &["completions", "tcsh"]);
    assert_eq!(status, 2);
    assert!(said.contains("bash, elvish, fish"), "{said}");
}

#[test]
fn every_command_has_a_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let dir = folder.path().join("man1");
    // Twice: pages are replaced.
    for _ in 0..2 {
        let (status, text, said) = trilith(folder.path(), &["manual", "man1"]);
        assert_eq!(status, 0, "{said}");
        assert!(text.contains("trilith-run.1"), "{text}");
    }
    let page = |name: &str| std::fs::read_to_string(dir.join(name)).expect("a page");
    for command in
        ["run", "check", "modes", "sweep", "compare", "import", "record", "lsp", "manual"]
    {
        assert!(page("trilith.1").contains(&format!("trilith\\-{command}(1)")), "{command}");
        assert!(page(&format!("trilith-{command}.1")).starts_with(".ie"), "{command}");
    }
    assert!(page("trilith-run.1").contains("checkpoint\\-at"));
    let (status, _, said) = trilith(folder.path(), &["manual", "man1/trilith.1"]);
    assert_eq!(status, 2, "a file where the folder should be");
    assert!(said.contains("cannot be written"), "{said}");
}
