//! The conversation: what a client asks, and what it is answered.

use crate::check::{Checker, Job};
use crate::documents::Documents;
use crate::looking::{Looking, symbols};
use crate::messages::{self, MessageError};
use crate::position::Encoding;
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response};
use lsp_types::notification as n;
use lsp_types::notification::Notification as _;
use lsp_types::request as r;
use lsp_types::request::Request as _;
use lsp_types::{
    CompletionOptions, CompletionParams, DidChangeTextDocumentParams, DidCloseTextDocumentParams,
    DidOpenTextDocumentParams, DidSaveTextDocumentParams, DocumentSymbolParams,
    GotoDefinitionParams, HoverParams, OneOf, PositionEncodingKind, ServerCapabilities,
    TextDocumentPositionParams, TextDocumentSyncCapability, TextDocumentSyncKind,
    TextDocumentSyncOptions, Uri,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::{BufReader, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use trilith::Registry;

/// Answers a client until it says `exit`. True where it has said `shutdown` before, as it should.
///
/// # Errors
/// A message that cannot be read, or the end of the stream without a word.
pub fn serve(
    registry: &Registry,
    input: impl Read + Send + 'static,
    output: impl Write + Send + 'static,
) -> Result<bool, MessageError> {
    let (sender, messages) = channel();
    // What a client sends is taken at once: else it might wait for us while we wait for it to take an answer.
    thread::spawn(move || {
        let mut input = BufReader::new(input);
        loop {
            let message = messages::read(&mut input).and_then(|m| m.ok_or(MessageError::Gone));
            let ends = message.is_err();
            if sender.send(message).is_err() || ends {
                return;
            }
        }
    });
    let output = Output(Arc::new(Mutex::new(output)));
    let (jobs, work) = channel();
    let (kinds, out) = (registry.clone(), output.clone());
    thread::spawn(move || check_all(&kinds, &work, &out));
    let mut server = Server {
        registry,
        output,
        jobs,
        documents: Documents::default(),
        snippets: false,
        phase: Phase::Before,
    };
    server.converse(&messages)
}

/// Looks at texts as they come: of several jobs that wait, at the texts of the last.
fn check_all(registry: &Registry, work: &Receiver<Job>, output: &Output<impl Write>) {
    let mut checker = Checker::default();
    while let Ok(mut job) = work.recv() {
        while let Ok(mut next) = work.try_recv() {
            next.which.append(&mut job.which);
            job = next;
        }
        for params in checker.check(registry, &job) {
            output.notify::<n::PublishDiagnostics>(params);
        }
    }
}

/// Where answers go.
struct Output<W>(Arc<Mutex<W>>);

impl<W> Clone for Output<W> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<W: Write> Output<W> {
    fn send(&self, message: impl Into<Message>) {
        let mut stream = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        // A client that hears nothing any more says nothing either: there the conversation ends.
        let _ = message.into().write(&mut *stream);
    }

    fn notify<N: n::Notification<Params: Serialize>>(&self, params: N::Params) {
        // Names, texts and numbers: nothing that JSON does not have.
        let params = serde_json::to_value(params).unwrap_or_default();
        self.send(Notification { method: N::METHOD.into(), params });
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Phase {
    Before,
    Serving,
    After,
}

struct Server<'r, W> {
    registry: &'r Registry,
    output: Output<W>,
    jobs: Sender<Job>,
    documents: Documents,
    /// The client takes texts with a place for the cursor.
    snippets: bool,
    phase: Phase,
}

/// Why a request has no answer.
type Refusal = (ErrorCode, String);

impl<W: Write> Server<'_, W> {
    fn converse(
        &mut self,
        messages: &Receiver<Result<Message, MessageError>>,
    ) -> Result<bool, MessageError> {
        while let Ok(message) = messages.recv() {
            match message? {
                Message::Request(request) => self.answer(request),
                Message::Notification(it) if it.method == n::Exit::METHOD => {
                    return Ok(self.phase == Phase::After);
                }
                Message::Notification(it) => {
                    // What is done to a text is done at the end, or not at all.
                    let _ = catch_unwind(AssertUnwindSafe(|| self.hear(it)));
                }
                // Nothing was asked.
                Message::Response(_) => {}
            }
        }
        Err(MessageError::Gone)
    }

    fn answer(&mut self, request: Request) {
        let id = request.id.clone();
        let made = catch_unwind(AssertUnwindSafe(|| self.result(request)));
        let stumbled = || (ErrorCode::InternalError, "an error of the program itself".to_owned());
        self.reply(id, made.unwrap_or_else(|_| Err(stumbled())));
    }

    fn reply(&self, id: RequestId, result: Result<Value, Refusal>) {
        let response = match result {
            Ok(value) => Response::new_ok(id, value),
            Err((code, message)) => Response::new_err(id, code as i32, message),
        };
        self.output.send(response);
    }

    fn result(&mut self, request: Request) -> Result<Value, Refusal> {
        let Request { method, params, .. } = request;
        match (self.phase, method.as_str()) {
            (Phase::Before, r::Initialize::METHOD) => return Ok(self.initialize(&params)),
            (Phase::Before, _) => {
                return Err((ErrorCode::ServerNotInitialized, "`initialize` comes first".into()));
            }
            (Phase::After, _) | (Phase::Serving, r::Initialize::METHOD) => {
                return Err((ErrorCode::InvalidRequest, format!("`{method}` comes too late")));
            }
            (Phase::Serving, _) => {}
        }
        match method.as_str() {
            r::Shutdown::METHOD => {
                self.phase = Phase::After;
                Ok(Value::Null)
            }
            r::Completion::METHOD => {
                let p: CompletionParams = taken(params)?;
                self.at(&p.text_document_position, |it| value(it.completion(self.snippets)))
            }
            r::HoverRequest::METHOD => {
                let p: HoverParams = taken(params)?;
                self.at(&p.text_document_position_params, |it| value(it.hover()))
            }
            r::GotoDefinition::METHOD => {
                let p: GotoDefinitionParams = taken(params)?;
                self.at(&p.text_document_position_params, |it| value(it.definition()))
            }
            r::DocumentSymbolRequest::METHOD => {
                let p: DocumentSymbolParams = taken(params)?;
                let document = self.documents.get(&p.text_document.uri);
                Ok(value(document.map(symbols)))
            }
            _ => Err((ErrorCode::MethodNotFound, format!("`{method}` is not answered here"))),
        }
    }

    fn initialize(&mut self, params: &Value) -> Value {
        self.phase = Phase::Serving;
        let offered = params.pointer("/capabilities/general/positionEncodings");
        let offered = offered
            .and_then(|all| serde_json::from_value::<Vec<PositionEncodingKind>>(all.clone()).ok());
        self.documents.encoding = Encoding::chosen(offered.as_deref());
        let snippets = "/capabilities/textDocument/completion/completionItem/snippetSupport";
        self.snippets = params.pointer(snippets) == Some(&Value::Bool(true));
        let capabilities = ServerCapabilities {
            position_encoding: Some(self.documents.encoding.kind()),
            text_document_sync: Some(TextDocumentSyncCapability::Options(
                TextDocumentSyncOptions {
                    open_close: Some(true),
                    change: Some(TextDocumentSyncKind::INCREMENTAL),
                    save: Some(true.into()),
                    ..Default::default()
                },
            )),
            completion_provider: Some(CompletionOptions {
                trigger_characters: Some(["\"", "(", "[", ":", " "].map(str::to_owned).to_vec()),
                ..Default::default()
            }),
            hover_provider: Some(true.into()),
            definition_provider: Some(OneOf::Left(true)),
            document_symbol_provider: Some(OneOf::Left(true)),
            ..Default::default()
        };
        json!({
            "capabilities": value(capabilities),
            "serverInfo": { "name": "trilith", "version": trilith::VERSION },
        })
    }

    fn hear(&mut self, it: Notification) {
        if self.phase != Phase::Serving {
            return;
        }
        // A notification has no answer: one that cannot be understood is passed over, as the protocol wants it.
        let uri = match it.method.as_str() {
            n::DidOpenTextDocument::METHOD => {
                let Ok(p) = taken::<DidOpenTextDocumentParams>(it.params) else { return };
                let d = p.text_document;
                self.documents.open(d.uri.clone(), d.version, d.text);
                d.uri
            }
            n::DidChangeTextDocument::METHOD => {
                let Ok(p) = taken::<DidChangeTextDocumentParams>(it.params) else { return };
                let d = p.text_document;
                self.documents.change(&d.uri, d.version, p.content_changes);
                d.uri
            }
            n::DidSaveTextDocument::METHOD => {
                let Ok(p) = taken::<DidSaveTextDocumentParams>(it.params) else { return };
                p.text_document.uri
            }
            n::DidCloseTextDocument::METHOD => {
                let Ok(p) = taken::<DidCloseTextDocumentParams>(it.params) else { return };
                let uri = p.text_document.uri;
                let which = self.hanging(&uri);
                self.documents.close(&uri);
                return self.look(which);
            }
            _ => return,
        };
        self.look(self.hanging(&uri));
    }

    /// A text, those that include it, and those that it includes.
    fn hanging(&self, uri: &Uri) -> BTreeSet<String> {
        let mut which = BTreeSet::from([uri.as_str().to_owned()]);
        if let Some(document) = self.documents.get(uri) {
            let path = &document.file.path;
            let parts = self.documents.with_included(&document.file);
            let parts = parts.iter().filter_map(|f| self.documents.at(&f.path));
            let all = self.documents.including(path).into_iter().chain(parts);
            which.extend(all.map(|d| d.uri.as_str().to_owned()));
        }
        which
    }

    fn look(&self, which: BTreeSet<String>) {
        // The thread that checks lives as long as there are jobs.
        let _ = self.jobs.send(Job { documents: self.documents.clone(), which });
    }

    /// What there is to say of a place; nothing of a text that is not open.
    fn at(
        &self,
        of: &TextDocumentPositionParams,
        answer: impl FnOnce(&Looking<'_>) -> Value,
    ) -> Result<Value, Refusal> {
        let Some(document) = self.documents.get(&of.text_document.uri) else {
            return Ok(Value::Null);
        };
        let at = document.lines.byte(&document.file.text, of.position);
        Ok(answer(&Looking::new(self.registry, &self.documents, document, at)))
    }
}

/// Parameters as they should be.
fn taken<T: DeserializeOwned>(params: Value) -> Result<T, Refusal> {
    serde_json::from_value(params).map_err(|e| (ErrorCode::InvalidParams, e.to_string()))
}

fn value(of: impl Serialize) -> Value {
    // Names, texts and numbers: nothing that JSON does not have.
    serde_json::to_value(of).unwrap_or_default()
}
