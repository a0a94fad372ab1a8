//! The thread that serves the page.

use super::account::Account;
use super::address::WebAddress;
use super::answers::{Asked, Site};
use super::board::Board;
use super::origin::OriginCheck;
use super::page;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::net::TcpStream;
use tokio::runtime::Runtime;
use tokio::sync::oneshot;
use tokio::task::AbortHandle;
use tokio::time::{sleep, timeout};

/// The page of a session, served until this is dropped.
pub struct Web {
    board: Arc<Board>,
    address: SocketAddr,
    asked: Receiver<Asked>,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum WebError {
    /// Nobody can be listened to there.
    #[error("{address}: the page cannot be served here: {problem}. Give another address or port")]
    Listen {
        /// Where.
        address: WebAddress,
        /// What the system says.
        problem: std::io::ErrorKind,
    },
    /// The system has no more threads or files.
    #[error("the page cannot be served: {0}. End other programs")]
    Start(std::io::ErrorKind),
}

/// What was asked and not looked at.
const MOST_ASKED: usize = 4;

impl Web {
    /// Serves the page of a session at `address`, from `account` on.
    ///
    /// # Errors
    ///
    /// An address that is taken or not of this machine.
    pub fn serve(address: WebAddress, account: Account) -> Result<Self, WebError> {
        let listen = |error: std::io::Error| WebError::Listen { address, problem: error.kind() };
        let start = |error: std::io::Error| WebError::Start(error.kind());
        let listener = TcpListener::bind(address.0).map_err(listen)?;
        listener.set_nonblocking(true).map_err(listen)?;
        let address = listener.local_addr().map_err(listen)?;
        let runtime =
            tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(start)?;
        let board = Arc::new(Board::new(page::nonce(), account));
        let (ask, asked) = mpsc::sync_channel(MOST_ASKED);
        let site =
            Site { board: Arc::clone(&board), origin: OriginCheck::new(&address), asked: ask };
        let (stop, stopped) = oneshot::channel();
        let thread = std::thread::Builder::new().name("eyebolt-web".to_owned());
        let thread =
            thread.spawn(move || serve(&runtime, listener, site, stopped)).map_err(start)?;
        Ok(Self { board, address, asked, stop: Some(stop), thread: Some(thread) })
    }

    /// Where the page is.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Where what is new is put.
    pub fn board(&self) -> &Arc<Board> {
        &self.board
    }

    /// What somebody asked for, if anybody did.
    pub fn asked(&self) -> Option<Asked> {
        self.asked.try_recv().ok()
    }
}

impl Drop for Web {
    /// Pages that are open take the last state and the report with them, for which they have a few seconds.
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            // A thread that panicked serves no more either.
            let _ = thread.join();
        }
    }
}

fn serve(runtime: &Runtime, listener: TcpListener, site: Site, stopped: oneshot::Receiver<()>) {
    let site = Arc::new(site);
    runtime.block_on(async {
        let Ok(listener) = tokio::net::TcpListener::from_std(listener) else { return };
        let board = Arc::clone(&site.board);
        tokio::spawn(async move { board.make_pictures().await });
        let mut connections = Connections::default();
        until(stopped, accept(&listener, &mut connections, &site)).await;
        if connections.are_open() {
            site.board.close();
            let last_questions = accept(&listener, &mut connections, &site);
            let _ = timeout(LAST_QUESTIONS, last_questions).await;
            connections.say_farewell(&site.board).await;
        }
    });
}

async fn accept(
    listener: &tokio::net::TcpListener,
    connections: &mut Connections,
    site: &Arc<Site>,
) -> Infallible {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => connections.add(stream, Arc::clone(site)),
            // Out of files; later there may be some.
            Err(_) => sleep(PAUSE).await,
        }
    }
}

/// Works until `stopped`.
async fn until(stopped: oneshot::Receiver<()>, work: impl Future<Output = Infallible>) {
    let (mut stopped, mut work) = (std::pin::pin!(stopped), std::pin::pin!(work));
    std::future::poll_fn(|context| {
        if stopped.as_mut().poll(context).is_ready() {
            return std::task::Poll::Ready(());
        }
        work.as_mut().poll(context).map(|never| match never {})
    })
    .await;
}

/// Everybody that is connected, the oldest first.
#[derive(Default)]
struct Connections {
    open: VecDeque<AbortHandle>,
    graceful: GracefulShutdown,
}

/// Connections at a time; a browser has six at most. Beyond, the oldest makes room: a page that was shut out comes back by
/// itself, and who holds connections without a use shuts nobody out.
const MOST_CONNECTIONS: usize = 96;
/// Headers of a request are read for so long, and no longer than that.
const PATIENCE: Duration = Duration::from_secs(20);
const MOST_HEADER_BYTES: usize = 16 << 10;
const PAUSE: Duration = Duration::from_millis(100);
/// How long pages have to ask for the report at the end, and then to get it.
const LAST_QUESTIONS: Duration = Duration::from_millis(700);
const LAST_ANSWERS: Duration = Duration::from_secs(5);

impl Connections {
    fn add(&mut self, stream: TcpStream, site: Arc<Site>) {
        self.open.retain(|open| !open.is_finished());
        if self.open.len() >= MOST_CONNECTIONS
            && let Some(oldest) = self.open.pop_front()
        {
            oldest.abort();
        }
        // Answers are small, and each is awaited.
        let _ = stream.set_nodelay(true);
        let service = service_fn(move |request| {
            let site = Arc::clone(&site);
            async move { Ok::<_, Infallible>(site.answer(&request).await) }
        });
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(PATIENCE)
            .max_buf_size(MOST_HEADER_BYTES)
            .serve_connection(TokioIo::new(stream), service);
        // What breaks a connection is over with it.
        let served = self.graceful.watch(connection);
        let task = tokio::spawn(async move { drop(served.await) });
        self.open.push_back(task.abort_handle());
    }

    fn are_open(&mut self) -> bool {
        self.open.retain(|open| !open.is_finished());
        !self.open.is_empty()
    }

    /// Lets whoever waits go, and whoever is being answered have all of it.
    async fn say_farewell(self, board: &Board) {
        board.close();
        let _ = timeout(LAST_ANSWERS, self.graceful.shutdown()).await;
    }
}
