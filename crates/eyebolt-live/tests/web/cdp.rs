//! A browser that is told what to do, over its debugging pipe (Chrome DevTools Protocol).

use crate::chromium;
use serde_json::{Value, json};
use std::cell::{Cell, RefCell};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Stdio};

/// A browser without a window.
pub struct Browser {
    child: Child,
    pipe: RefCell<(File, BufReader<File>)>,
    next: Cell<u64>,
    /// What happened in pages, with the page that it happened in.
    events: RefCell<Vec<(String, Value)>>,
    _folder: tempfile::TempDir,
}

/// A page in it.
pub struct Tab<'a> {
    browser: &'a Browser,
    session: String,
}

impl Browser {
    /// `None` without one, which was said.
    pub fn start() -> Option<Self> {
        if !cfg!(unix) {
            return None;
        }
        let program = chromium::browser()?;
        let folder = tempfile::tempdir().unwrap();
        let [to, from] = ["to", "from"].map(|name| folder.path().join(name));
        assert!(Command::new("mkfifo").args([&to, &from]).status().unwrap().success());
        let script = "exec \"$0\" --headless --no-sandbox --no-first-run --disable-dev-shm-usage \
            --disable-background-networking --disable-component-update --hide-scrollbars \
            --remote-debugging-pipe --user-data-dir=\"$1/profile\" about:blank 3<\"$1/to\" 4>\"$1/from\"";
        let mut command = Command::new("sh");
        command.args(["-c", script]).arg(program).arg(folder.path());
        let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        // In the order in which the shell opens them.
        let to = OpenOptions::new().write(true).open(to).unwrap();
        let from = BufReader::new(File::open(from).unwrap());
        let (next, events) = (Cell::new(1), RefCell::default());
        Some(Self { child, pipe: RefCell::new((to, from)), next, events, _folder: folder })
    }

    /// Has something done, in a page or in the browser itself; what came of it.
    fn call(&self, session: Option<&str>, method: &str, parameters: &Value) -> Value {
        let id = self.next.replace(self.next.get() + 1);
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if let Some(session) = session {
            message["sessionId"] = session.into();
        }
        let mut pipe = self.pipe.borrow_mut();
        pipe.0.write_all(format!("{message}\0").as_bytes()).unwrap();
        loop {
            let mut bytes = Vec::new();
            pipe.1.read_until(0, &mut bytes).unwrap();
            assert_eq!(bytes.pop(), Some(0), "the browser is still there");
            let mut told: Value = serde_json::from_slice(&bytes).unwrap();
            if told["id"] == id {
                assert!(told.get("error").is_none(), "{method}: {told}");
                return told["result"].take();
            }
            if let Some(session) = told["sessionId"].as_str().map(str::to_owned) {
                self.events.borrow_mut().push((session, told));
            }
        }
    }

    /// A page that shares nothing with others, at `url`.
    pub fn open(&self, url: &str) -> Tab<'_> {
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        let own = self.call(None, "Target.createBrowserContext", &json!({}));
        let own = text(&own["browserContextId"]);
        let blank = json!({ "url": "about:blank", "browserContextId": own });
        let target = text(&self.call(None, "Target.createTarget", &blank)["targetId"]);
        let attach = json!({ "targetId": target, "flatten": true });
        let session = text(&self.call(None, "Target.attachToTarget", &attach)["sessionId"]);
        let tab = Tab { browser: self, session };
        for domain in ["Runtime.enable", "Log.enable", "Page.enable"] {
            tab.call(domain, &json!({}));
        }
        tab.call("Page.navigate", &json!({ "url": url }));
        tab
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.pipe.get_mut().0.write_all(b"{\"id\":0,\"method\":\"Browser.close\"}\0");
        let _ = self.child.wait();
    }
}

impl Tab<'_> {
    pub fn call(&self, method: &str, parameters: &Value) -> Value {
        self.browser.call(Some(&self.session), method, parameters)
    }

    /// The value of an expression, or of what it promises.
    pub fn value(&self, expression: &str) -> Value {
        let ask = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let mut told = self.call("Runtime.evaluate", &ask);
        assert!(told.get("exceptionDetails").is_none(), "{expression}: {told}");
        told["result"]["value"].take()
    }

    /// Waits until `expression` is true in the page.
    pub fn until(&self, expression: &str) {
        let wait = format!(
            "(async () => {{ for (let turn = 0; turn < 1200; turn += 1) {{ \
               try {{ if ({expression}) return true; }} catch {{ }} \
               await new Promise((done) => setTimeout(done, 50)); }} \
             return document.body.innerText; }})()"
        );
        assert_eq!(self.value(&wait), true, "waited in vain until {expression}");
    }

    /// What went wrong in the page, as its console has it.
    pub fn problems(&self) -> Vec<String> {
        // What was told before is here with the answer.
        self.value("1");
        let events = self.browser.events.borrow();
        let own = events.iter().filter(|(session, _)| *session == self.session);
        let bad = own.filter(|(_, event)| match event["method"].as_str() {
            Some("Runtime.exceptionThrown" | "Runtime.consoleAPICalled") => true,
            Some("Log.entryAdded") => event["params"]["entry"]["level"] == "error",
            _ => false,
        });
        bad.map(|(_, event)| event["params"].to_string()).collect()
    }

    /// As a screen of this size has it, light or dark.
    pub fn screen(&self, [width, height]: [u32; 2], scheme: &str) {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 2, "mobile": width < 600 });
        self.call("Emulation.setDeviceMetricsOverride", &size);
        let scheme = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.call("Emulation.setEmulatedMedia", &scheme);
    }

    /// The whole page as a PNG in base64.
    pub fn screenshot(&self) -> String {
        let all = json!({ "captureBeyondViewport": true });
        self.call("Page.captureScreenshot", &all)["data"].as_str().unwrap().to_owned()
    }
}
