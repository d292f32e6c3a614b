//! Zenoh for C++: the part of the `zenoh` crate that Urto's transport needs, through a `cxx` bridge.
//!
//! Rules of this file:
//! - Every function of the bridge runs inside `guarded` (calls from C++) or `report` (calls into C++), so that neither
//!   a panic nor a C++ exception crosses the border or reaches Zenoh's threads.
//! - No setting lives here: `open` takes the whole configuration as the JSON that config.cpp writes.

use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::Duration;

use cxx::UniquePtr;
use guard::{guarded, report, Error};
use zenoh::bytes::Encoding;
use zenoh::key_expr::KeyExpr;
use zenoh::qos::{CongestionControl, Priority, Reliability};
use zenoh::query::{ConsolidationMode, QueryTarget};
use zenoh::sample::SampleKind;
use zenoh::{Config, Wait};

mod guard;

#[cxx::bridge(namespace = "urto::zenoh")]
mod ffi {
    /// How a publisher sends.
    struct PublisherSettings {
        encoding: String,
        best_effort: bool,
        high_priority: bool,
    }

    /// A question for every queryable that matches.
    struct GetSettings {
        selector: String,
        encoding: String,
        timeout_ms: u64,
    }

    unsafe extern "C++" {
        include!("transport/zenoh/handlers.h");

        type SampleHandler;
        fn on_sample(self: &SampleHandler, key: &str, payload: &[u8]) -> Result<()>;

        type LivelinessHandler;
        fn on_change(self: &LivelinessHandler, key: &str, alive: bool) -> Result<()>;

        type QueryHandler;
        fn on_query(self: &QueryHandler, query: Box<IncomingQuery>) -> Result<()>;

        type ReplyHandler;
        fn on_reply(self: &ReplyHandler, is_error: bool, key: &str, payload: &[u8]) -> Result<()>;
        fn on_done(self: &ReplyHandler) -> Result<()>;
    }

    extern "Rust" {
        type Session;
        fn open(config_json: &str) -> Result<Box<Session>>;
        fn endpoints(self: &Session) -> Result<Vec<String>>;
        fn publisher(self: &Session, key: &str, settings: &PublisherSettings) -> Result<Box<Publisher>>;
        fn subscriber(
            self: &Session,
            key_expression: &str,
            handler: UniquePtr<SampleHandler>,
        ) -> Result<Box<Subscriber>>;
        fn queryable(self: &Session, key_expression: &str, handler: UniquePtr<QueryHandler>) -> Result<Box<Queryable>>;
        fn token(self: &Session, key: &str) -> Result<Box<Token>>;
        fn liveliness_subscriber(
            self: &Session,
            key_expression: &str,
            handler: UniquePtr<LivelinessHandler>,
        ) -> Result<Box<Subscriber>>;
        fn get(self: &Session, settings: &GetSettings, payload: &[u8], handler: UniquePtr<ReplyHandler>) -> Result<()>;
        fn close(self: &Session) -> Result<()>;

        type Publisher;
        fn put(self: &Publisher, payload: &[u8]) -> Result<()>;

        // Dropping one of these undeclares it without waiting for its callbacks.
        type Subscriber;
        type Queryable;
        type Token;

        type IncomingQuery;
        fn key(self: &IncomingQuery) -> &str;
        fn parameters(self: &IncomingQuery) -> &str;
        fn payload(self: &IncomingQuery) -> Vec<u8>;
        fn reply(self: &IncomingQuery, key: &str, payload: &[u8], encoding: &str) -> Result<()>;
        fn reply_error(self: &IncomingQuery, payload: &[u8]) -> Result<()>;
    }
}

// SAFETY: the handlers are const on the C++ side and made of std::function, whose targets transport.h requires to be
// callable from any thread, several at a time.
unsafe impl Send for ffi::SampleHandler {}
unsafe impl Sync for ffi::SampleHandler {}
unsafe impl Send for ffi::LivelinessHandler {}
unsafe impl Sync for ffi::LivelinessHandler {}
unsafe impl Send for ffi::QueryHandler {}
unsafe impl Sync for ffi::QueryHandler {}
unsafe impl Send for ffi::ReplyHandler {}
unsafe impl Sync for ffi::ReplyHandler {}

/// A publisher that is still declared when its session is closed would keep the session in memory for ever: the session
/// remembers the publisher and that remembers the session. So close() takes the publishers out first.
type PublisherSlot = Mutex<Option<Arc<zenoh::pubsub::Publisher<'static>>>>;

pub struct Session {
    inner: zenoh::Session,
    publishers: Mutex<Vec<Weak<PublisherSlot>>>,
}
pub struct Publisher(Arc<PublisherSlot>);
pub struct Subscriber(#[allow(dead_code)] zenoh::pubsub::Subscriber<()>);
pub struct Queryable(#[allow(dead_code)] zenoh::query::Queryable<()>);
pub struct Token(#[allow(dead_code)] zenoh::liveliness::LivelinessToken);
pub struct IncomingQuery(zenoh::query::Query);

/// Calls `on_done` when Zenoh drops the callback of a get, which it does after the last reply.
struct ReplySink(UniquePtr<ffi::ReplyHandler>);

impl Drop for ReplySink {
    fn drop(&mut self) {
        report(|| self.0.on_done());
    }
}

fn key_expr(text: &str) -> Result<KeyExpr<'static>, Error> {
    KeyExpr::new(text.to_string())
}

fn open(config_json: &str) -> Result<Box<Session>, Error> {
    guarded(|| {
        zenoh::try_init_log_from_env(); // RUST_LOG=zenoh=debug shows what Zenoh does
        let config = Config::from_json5(config_json)?;
        Ok(Box::new(Session { inner: zenoh::open(config).wait()?, publishers: Mutex::default() }))
    })
}

impl Session {
    fn endpoints(&self) -> Result<Vec<String>, Error> {
        guarded(|| Ok(self.inner.info().locators().wait().iter().map(|locator| locator.to_string()).collect()))
    }

    fn publisher(&self, key: &str, settings: &ffi::PublisherSettings) -> Result<Box<Publisher>, Error> {
        guarded(|| {
            let reliability = if settings.best_effort { Reliability::BestEffort } else { Reliability::Reliable };
            let priority = if settings.high_priority { Priority::DataHigh } else { Priority::Data };
            // Drop, never block: one stopped client would make put() wait for seconds (docs/decisions/0001).
            let publisher = self
                .inner
                .declare_publisher(key_expr(key)?)
                .encoding(Encoding::from(settings.encoding.as_str()))
                .congestion_control(CongestionControl::Drop)
                .priority(priority)
                .reliability(reliability)
                .wait()?;
            let slot = Arc::new(Mutex::new(Some(Arc::new(publisher))));
            let mut known = self.publishers.lock().unwrap_or_else(PoisonError::into_inner);
            known.retain(|other| other.strong_count() > 0);
            known.push(Arc::downgrade(&slot));
            Ok(Box::new(Publisher(slot)))
        })
    }

    fn subscriber(
        &self,
        key_expression: &str,
        handler: UniquePtr<ffi::SampleHandler>,
    ) -> Result<Box<Subscriber>, Error> {
        guarded(|| {
            let subscriber = self
                .inner
                .declare_subscriber(key_expr(key_expression)?)
                .callback(move |sample| {
                    if sample.kind() == SampleKind::Put {
                        report(|| handler.on_sample(sample.key_expr().as_str(), &sample.payload().to_bytes()));
                    }
                })
                .wait()?;
            Ok(Box::new(Subscriber(subscriber)))
        })
    }

    fn queryable(&self, key_expression: &str, handler: UniquePtr<ffi::QueryHandler>) -> Result<Box<Queryable>, Error> {
        guarded(|| {
            let queryable = self
                .inner
                .declare_queryable(key_expr(key_expression)?)
                .callback(move |query| report(|| handler.on_query(Box::new(IncomingQuery(query)))))
                .wait()?;
            Ok(Box::new(Queryable(queryable)))
        })
    }

    fn token(&self, key: &str) -> Result<Box<Token>, Error> {
        guarded(|| Ok(Box::new(Token(self.inner.liveliness().declare_token(key_expr(key)?).wait()?))))
    }

    fn liveliness_subscriber(
        &self,
        key_expression: &str,
        handler: UniquePtr<ffi::LivelinessHandler>,
    ) -> Result<Box<Subscriber>, Error> {
        guarded(|| {
            let subscriber = self
                .inner
                .liveliness()
                .declare_subscriber(key_expr(key_expression)?)
                .history(true)
                .callback(move |sample| {
                    report(|| handler.on_change(sample.key_expr().as_str(), sample.kind() == SampleKind::Put));
                })
                .wait()?;
            Ok(Box::new(Subscriber(subscriber)))
        })
    }

    fn get(
        &self,
        settings: &ffi::GetSettings,
        payload: &[u8],
        handler: UniquePtr<ffi::ReplyHandler>,
    ) -> Result<(), Error> {
        guarded(|| {
            let sink = ReplySink(handler);
            self.inner
                .get(settings.selector.clone())
                .payload(payload.to_vec())
                .encoding(Encoding::from(settings.encoding.as_str()))
                .target(QueryTarget::All)
                .consolidation(ConsolidationMode::None)
                .timeout(Duration::from_millis(settings.timeout_ms))
                .callback(move |reply| {
                    let sink = &sink; // the whole sink moves into the closure, so that its drop comes last
                    report(|| match reply.result() {
                        Ok(sample) => sink.0.on_reply(false, sample.key_expr().as_str(), &sample.payload().to_bytes()),
                        Err(error) => sink.0.on_reply(true, "", &error.payload().to_bytes()),
                    });
                })
                .wait()
        })
    }

    fn close(&self) -> Result<(), Error> {
        guarded(|| {
            let known = std::mem::take(&mut *self.publishers.lock().unwrap_or_else(PoisonError::into_inner));
            for slot in known.iter().filter_map(Weak::upgrade) {
                drop(slot.lock().unwrap_or_else(PoisonError::into_inner).take());
            }
            self.inner.close().wait()
        })
    }
}

impl Publisher {
    fn put(&self, payload: &[u8]) -> Result<(), Error> {
        guarded(|| {
            // Not under the lock: a subscriber of this very session is called from here, and may publish in turn.
            let publisher = self.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
            publisher.ok_or("the session was closed")?.put(payload.to_vec()).wait()
        })
    }
}

impl IncomingQuery {
    fn key(&self) -> &str {
        self.0.key_expr().as_str()
    }

    fn parameters(&self) -> &str {
        self.0.parameters().as_str()
    }

    fn payload(&self) -> Vec<u8> {
        self.0.payload().map(|payload| payload.to_bytes().into_owned()).unwrap_or_default()
    }

    fn reply(&self, key: &str, payload: &[u8], encoding: &str) -> Result<(), Error> {
        guarded(|| self.0.reply(key_expr(key)?, payload.to_vec()).encoding(Encoding::from(encoding)).wait())
    }

    fn reply_error(&self, payload: &[u8]) -> Result<(), Error> {
        guarded(|| self.0.reply_err(payload.to_vec()).wait())
    }
}
