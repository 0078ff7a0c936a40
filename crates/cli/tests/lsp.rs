//! `trilith lsp` as an editor speaks with it: JSON-RPC over pipes.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// A program that ends with its test.
struct Server {
    child: Child,
    to: Option<ChildStdin>,
    /// What it says.
    from: Receiver<Value>,
    asked: i64,
    /// Notifications that came while an answer was awaited.
    noted: Vec<Value>,
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Server {
    fn start() -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
        let piped = command.arg("lsp").stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = piped.stderr(Stdio::piped()).spawn().unwrap();
        let (sender, from) = channel();
        let mut said = BufReader::new(child.stdout.take().unwrap());
        std::thread::spawn(move || {
            while let Some(message) = message(&mut said) {
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        Self { to: child.stdin.take(), child, from, asked: 0, noted: Vec::new() }
    }

    /// A server that has been told what the editor can do, and what it can do itself.
    fn with(capabilities: Value) -> (Self, Value) {
        let mut server = Self::start();
        let answer = server.ask("initialize", json!({ "capabilities": capabilities }));
        server.tell("initialized", json!({}));
        (server, answer["result"]["capabilities"].clone())
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        self.raw(format!("Content-Length: {}\r\n\r\n{text}", text.len()).as_bytes());
    }

    fn raw(&mut self, bytes: &[u8]) {
        let to = self.to.as_mut().unwrap();
        to.write_all(bytes).and_then(|()| to.flush()).unwrap();
    }

    fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.asked += 1;
        let id = self.asked;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let message = self.hear();
            if message["id"] == id {
                return message;
            }
            self.noted.push(message);
        }
    }

    fn hear(&mut self) -> Value {
        self.from.recv_timeout(Duration::from_secs(120)).expect("the server says nothing")
    }

    /// What is said next of a file in this version.
    fn diagnostics(&mut self, uri: &str, version: Option<i64>) -> Vec<Value> {
        loop {
            let message = if self.noted.is_empty() { self.hear() } else { self.noted.remove(0) };
            let params = &message["params"];
            let of = message["method"] == "textDocument/publishDiagnostics" && params["uri"] == uri;
            if of && params["version"].as_i64() == version {
                return params["diagnostics"].as_array().unwrap().clone();
            }
        }
    }

    fn open(&mut self, uri: &str, text: &str) {
        let document = json!({ "uri": uri, "languageId": "ron", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
    }

    fn change(&mut self, uri: &str, version: i64, changes: &Value) {
        let document = json!({ "uri": uri, "version": version });
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.tell("textDocument/didChange", params);
    }

    fn at(&mut self, method: &str, uri: &str, (line, character): (usize, usize)) -> Value {
        let position = json!({ "line": line, "character": character });
        let params = json!({ "textDocument": { "uri": uri }, "position": position });
        self.ask(&format!("textDocument/{method}"), params)["result"].clone()
    }

    /// The exit status, and what was said to the terminal.
    fn end(&mut self) -> (Option<i32>, String) {
        self.to = None;
        let status = self.child.wait().unwrap();
        let mut said = String::new();
        self.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        (status.code(), said)
    }
}

/// The next message; none at the end.
fn message(from: &mut BufReader<ChildStdout>) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if from.read_line(&mut line).unwrap() == 0 {
            return None;
        }
        match line.trim_end().split_once(": ") {
            Some(("Content-Length", n)) => length = n.parse().unwrap(),
            Some(_) => {}
            None => break,
        }
    }
    let mut body = vec![0; length];
    from.read_exact(&mut body).unwrap();
    let message: Value = serde_json::from_slice(&body).unwrap();
    assert_eq!(message["jsonrpc"], "2.0");
    Some(message)
}

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    let path = path.canonicalize().unwrap().display().to_string().replace('\\', "/");
    let path = path.trim_start_matches("//?/");
    format!("file://{}{path}", if path.starts_with('/') { "" } else { "/" })
}

/// A small model, with what follows `node: ` and the rigidity of a spring.
fn model(stiffness: &str) -> String {
    format!(
        r#"(
    plane: XZ,
    nodes: {{ "fuß 🦶": (0, 0, 0) }},
    elements: {{
        "feder 🦶": Spring(node: "fuß 🦶", k1: "{stiffness}", ),
        "masse": Mass(node: "fuß 🦶", mass: "1 t"),
    }},
    supports: {{ "fuß 🦶": (Ux, Ry) }},
    cases: {{ "weight": Static(loads: [Gravity]) }},
)
"#
    )
}

/// Line and column, in units of UTF-16 or bytes, of the end of a part of a text.
fn behind(text: &str, part: &str, utf8: bool) -> (usize, usize) {
    let before = &text[..text.find(part).expect(part) + part.len()];
    let line = before.rsplit('\n').next().unwrap();
    let column = if utf8 { line.len() } else { line.encode_utf16().count() };
    (before.matches('\n').count(), column)
}

#[test]
fn an_editor_is_told_of_errors_completes_and_explains() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = model("5 kN");
    let uri = file(folder.path(), "m.ron", &wrong);
    for utf8 in [false, true] {
        let encodings = if utf8 { json!(["utf-8", "utf-16"]) } else { json!(["utf-16"]) };
        let (mut server, can) = Server::with(json!({
            "general": { "positionEncodings": encodings },
            "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } },
        }));
        assert_eq!(can["positionEncoding"], if utf8 { "utf-8" } else { "utf-16" });
        assert_eq!(can["hoverProvider"], true);

        server.open(&uri, &wrong);
        let told = server.diagnostics(&uri, Some(1));
        assert_eq!(told.len(), 1, "{told:?}");
        let (line, start) = behind(&wrong, "k1: ", utf8);
        let range = json!({
            "start": { "line": line, "character": start },
            "end": { "line": line, "character": start + "\"5 kN\"".len() },
        });
        assert_eq!(told[0]["range"], range);
        assert_eq!((&told[0]["code"], &told[0]["severity"]), (&json!("E0111"), &json!(1)));
        let message = told[0]["message"].as_str().unwrap();
        assert!(
            message.contains("must be a value in N/m") && message.contains("help: "),
            "{message}"
        );

        // Within `Spring(`, behind what it has.
        let all = server.at("completion", &uri, behind(&wrong, "\"5 kN\", ", utf8));
        let labels: Vec<&str> =
            all["items"].as_array().unwrap().iter().map(|i| i["label"].as_str().unwrap()).collect();
        assert!(labels.contains(&"k2") && labels.contains(&"axis1"), "{labels:?}");
        assert!(!labels.contains(&"k1") && !labels.contains(&"node"), "{labels:?}");
        // A name with a foot takes the place of all between the quotes.
        let (line, column) = behind(&wrong, "Spring(node: \"fuß", utf8);
        let all = server.at("completion", &uri, (line, column));
        let edit = &all["items"][0]["textEdit"];
        assert_eq!(edit["newText"], "fuß 🦶");
        let (_, end) = behind(&wrong, "Spring(node: \"fuß 🦶", utf8);
        assert_eq!(edit["range"]["end"], json!({ "line": line, "character": end }));
        // A kind comes with its brackets.
        let all = server.at("completion", &uri, behind(&wrong, "\"feder 🦶\": Sp", utf8));
        let items = all["items"].as_array().unwrap();
        let kind = items.iter().find(|i| i["label"] == "Gap").unwrap();
        assert_eq!(kind["textEdit"]["newText"], "Gap");

        let hover = server.at("hover", &uri, behind(&wrong, "fuß 🦶\", k", utf8));
        let text = hover["contents"]["value"].as_str().unwrap();
        assert!(text.starts_with("**k1**") && text.contains("N/m"), "{text}");
        assert_eq!(hover["range"]["start"]["character"], behind(&wrong, "fuß 🦶\", ", utf8).1);
        let place = server.at("definition", &uri, behind(&wrong, "Mass(node: \"fuß", utf8));
        let (line, start) = behind(&wrong, "nodes: { \"", utf8);
        assert_eq!(place["uri"], uri);
        assert_eq!(place["range"]["start"], json!({ "line": line, "character": start }));
        let outline =
            server.ask("textDocument/documentSymbol", json!({ "textDocument": { "uri": uri } }));
        assert_eq!(outline["result"][2]["children"][0]["name"], "feder 🦶");

        // `5 kN` becomes `5 kN/m`.
        let (line, column) = behind(&wrong, "5 kN", utf8);
        let at = json!({ "line": line, "character": column });
        let change = json!([{ "range": { "start": at, "end": at }, "text": "/m" }]);
        server.change(&uri, 2, &change);
        assert_eq!(server.diagnostics(&uri, Some(2)), Vec::<Value>::new());
        // All at once, and no RON any more.
        server.change(&uri, 3, &json!([{ "text": "(nodes: {" }]));
        let told = server.diagnostics(&uri, Some(3));
        assert_eq!((told.len(), &told[0]["code"]), (1, &json!("E0101")));

        assert_eq!(server.ask("shutdown", Value::Null)["result"], Value::Null);
        server.tell("exit", Value::Null);
        let (status, said) = server.end();
        assert_eq!((status, said.as_str()), (Some(0), ""));
    }
}

#[test]
fn errors_of_an_included_file_are_told_of_that_file() {
    let folder = tempfile::tempdir().unwrap();
    let part = "(properties: { \"f\": Spring(k1: \"1 kN/m\", kk: 1) })";
    let part_uri = file(folder.path(), "part ö.ron", part);
    let text = model("1 kN/m").replacen("plane", "include: [\"part ö.ron\"],\n    plane", 1);
    let uri = file(folder.path(), "m.ron", &text);
    // As an editor writes what is no letter.
    let part_uri = part_uri.replace(' ', "%20").replace('ö', "%C3%B6");
    let (mut server, _) = Server::with(json!({}));
    server.open(&uri, &text);
    let told = server.diagnostics(&part_uri, None);
    assert_eq!((told.len(), &told[0]["code"]), (1, &json!("E0103")), "{told:?}");
    assert_eq!(told[0]["range"]["start"]["character"], part.find("kk").unwrap());
    // The text in the editor counts, not that on the disk.
    server.open(&part_uri, &part.replace("kk", "k2"));
    assert_eq!(server.diagnostics(&part_uri, Some(1)), Vec::<Value>::new());
    let close = json!({ "textDocument": { "uri": part_uri } });
    server.tell("textDocument/didClose", close);
    assert_eq!(server.diagnostics(&part_uri, None).len(), 1);
    // A study is no model, whatever it speaks of.
    let study = "(model: \"m.ron\", axes: {}, nodes: 1, columns: {})";
    let other = file(folder.path(), "study.ron", study);
    server.open(&other, study);
    assert_eq!(server.diagnostics(&other, Some(1)), Vec::<Value>::new());
    // A file that no model includes is not asked for nodes and cases.
    let alone = file(folder.path(), "alone.ron", part);
    server.open(&alone, part);
    let told = server.diagnostics(&alone, Some(1));
    assert_eq!((told.len(), &told[0]["severity"]), (1, &json!(3)), "{told:?}");
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let mut server = Server::start();
    let error = |answer: Value| answer["error"]["code"].as_i64();
    assert_eq!(error(server.ask("textDocument/hover", json!({}))), Some(-32002));
    server.ask("initialize", json!({ "capabilities": null }));
    assert_eq!(error(server.ask("initialize", json!({}))), Some(-32600));
    assert_eq!(error(server.ask("textDocument/rename", json!({}))), Some(-32601));
    assert_eq!(error(server.ask("textDocument/hover", json!({ "position": -1 }))), Some(-32602));
    // Of a file that is not open there is nothing to say; a change without sense is passed over.
    assert_eq!(server.at("hover", "file:///nowhere.ron", (0, 0)), Value::Null);
    server.tell("textDocument/didChange", json!({ "textDocument": 7 }));
    server.tell("$/nonsense", json!([]));
    server.open("untitled:1", "(nodes: { \"a\": |");
    assert_eq!(server.diagnostics("untitled:1", Some(1)).len(), 1);
    let far = json!({ "line": 4_000_000_000_u32, "character": 4_000_000_000_u32 });
    server.change(
        "untitled:1",
        2,
        &json!([{ "range": { "start": far, "end": far }, "text": "🦶" }]),
    );
    assert_eq!(server.at("completion", "untitled:1", (9, 9))["items"][0]["label"], "For");
    server.tell("exit", Value::Null);
    assert_eq!(server.end(), (Some(1), String::new()), "no `shutdown` came before");
}

#[test]
fn damaged_and_huge_messages_end_it_with_an_error() {
    let deep = format!("{{\"id\":1,\"method\":\"a\",\"params\":{}", "[".repeat(1 << 20));
    for (bytes, part) in [
        (b"hello\r\n\r\n".to_vec(), "damaged"),
        (b"Content-Length: 7\r\n\r\n{\"a\": }".to_vec(), "none of JSON-RPC"),
        (b"Content-Length: 123456789012\r\n\r\n{".to_vec(), "123456789012 bytes is too long"),
        (format!("Content-Length: {}\r\n\r\n{deep}", deep.len()).into_bytes(), "none of JSON-RPC"),
        (b"Content-Length: 50\r\n\r\n{".to_vec(), "49 bytes before its end"),
        (Vec::new(), "ended before `exit`"),
    ] {
        let mut server = Server::start();
        server.raw(&bytes);
        let (status, said) = server.end();
        assert_eq!(status, Some(2), "{said}");
        assert!(said.contains(part) && !said.contains("panicked"), "{part}: {said}");
    }
}
