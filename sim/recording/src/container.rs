//! MCAP files (the MCAP specification, version 0, mcap.dev/spec): messages in chunks without
//! compression, and an index at the end. Checksums are 0, which means: none.

use std::collections::BTreeMap;
use std::mem::take;

const MAGIC: [u8; 8] = [0x89, b'M', b'C', b'A', b'P', 0x30, b'\r', b'\n'];
/// The size from which a chunk is closed, in bytes: tools read a chunk at a time.
const CHUNK: usize = 1 << 20;

/// Kinds of records.
mod op {
    pub(super) const HEADER: u8 = 0x01;
    pub(super) const FOOTER: u8 = 0x02;
    pub(super) const SCHEMA: u8 = 0x03;
    pub(super) const CHANNEL: u8 = 0x04;
    pub(super) const MESSAGE: u8 = 0x05;
    pub(super) const CHUNK: u8 = 0x06;
    pub(super) const MESSAGE_INDEX: u8 = 0x07;
    pub(super) const CHUNK_INDEX: u8 = 0x08;
    pub(super) const STATISTICS: u8 = 0x0b;
    pub(super) const SUMMARY_OFFSET: u8 = 0x0e;
    pub(super) const DATA_END: u8 = 0x0f;
}

/// The content of a record while it is written.
#[derive(Debug, Default)]
struct Content(Vec<u8>);

impl Content {
    fn u16(mut self, it: u16) -> Self {
        self.0.extend(it.to_le_bytes());
        self
    }

    fn u32(mut self, it: usize) -> Self {
        debug_assert!(u32::try_from(it).is_ok(), "no text or list of a file is that long");
        self.0.extend(u32::try_from(it).unwrap_or(u32::MAX).to_le_bytes());
        self
    }

    fn u64(mut self, it: u64) -> Self {
        self.0.extend(it.to_le_bytes());
        self
    }

    fn text(self, it: &str) -> Self {
        self.list(it.as_bytes())
    }

    /// Writes bytes after their number.
    fn list(self, bytes: &[u8]) -> Self {
        let mut it = self.u32(bytes.len());
        it.0.extend(bytes);
        it
    }
}

/// Returns the entries of a list, each two numbers.
fn pairs<K: Copy, V: Copy, const A: usize, const B: usize>(
    entries: impl Iterator<Item = (K, V)>,
    bytes: impl Fn(K, V) -> ([u8; A], [u8; B]),
) -> Vec<u8> {
    let mut all = Vec::new();
    for (key, value) in entries {
        let (key, value) = bytes(key, value);
        all.extend(key);
        all.extend(value);
    }
    all
}

fn record(out: &mut Vec<u8>, op: u8, content: &Content) {
    out.push(op);
    out.extend((content.0.len() as u64).to_le_bytes());
    out.extend(&content.0);
}

/// A channel: messages of one kind under one topic.
#[derive(Debug)]
struct Channel {
    content: Content,
    sent: u64,
}

/// A file while it is written.
#[derive(Debug)]
pub(crate) struct Container {
    out: Vec<u8>,
    /// Records of the open chunk.
    chunk: Vec<u8>,
    /// Times of the open chunk's messages and their places in it, by channel.
    index: BTreeMap<u16, Vec<(u64, u64)>>,
    chunks: Vec<Content>,
    schemas: BTreeMap<&'static str, (u16, Content)>,
    topics: BTreeMap<String, u16>,
    channels: BTreeMap<u16, Channel>,
    /// The first and the last time of all messages, and of those of the open chunk.
    times: Option<(u64, u64)>,
    chunk_times: Option<(u64, u64)>,
}

/// Returns the first and the last of some times and another one.
fn spanned(times: Option<(u64, u64)>, at: u64) -> (u64, u64) {
    times.map_or((at, at), |(first, last)| (first.min(at), last.max(at)))
}

impl Container {
    /// A file of a program.
    pub(crate) fn new(profile: &str, library: &str) -> Self {
        let mut out = MAGIC.to_vec();
        record(&mut out, op::HEADER, &Content::default().text(profile).text(library));
        Self {
            out,
            chunk: Vec::new(),
            index: BTreeMap::new(),
            chunks: Vec::new(),
            schemas: BTreeMap::new(),
            topics: BTreeMap::new(),
            channels: BTreeMap::new(),
            times: None,
            chunk_times: None,
        }
    }

    /// Writes a message, whose kind is a type of ROS 2. One more topic than there are numbers,
    /// 65,535, is not written.
    pub(crate) fn message(
        &mut self,
        topic: &str,
        kind: &'static str,
        schema: impl Fn(&str) -> String,
        time_ns: u64,
        data: &[u8],
    ) {
        let Some(id) = self.channel(topic, kind, schema) else { return };
        let place = self.chunk.len() as u64;
        let Some(channel) = self.channels.get_mut(&id) else { return };
        let sequence = usize::try_from(channel.sent & u64::from(u32::MAX)).unwrap_or_default();
        channel.sent += 1;
        let mut content = Content::default().u16(id).u32(sequence).u64(time_ns).u64(time_ns);
        content.0.extend(data);
        record(&mut self.chunk, op::MESSAGE, &content);
        self.index.entry(id).or_default().push((time_ns, place));
        self.times = Some(spanned(self.times, time_ns));
        self.chunk_times = Some(spanned(self.chunk_times, time_ns));
        if self.chunk.len() >= CHUNK {
            self.close();
        }
    }

    /// Returns the channel of a topic, which is announced before its first message.
    fn channel(
        &mut self,
        topic: &str,
        kind: &'static str,
        schema: impl Fn(&str) -> String,
    ) -> Option<u16> {
        if let Some(id) = self.topics.get(topic) {
            return Some(*id);
        }
        let id = u16::try_from(self.channels.len()).ok().filter(|it| *it < u16::MAX)?;
        // 0 would mean that there is no schema.
        let number = u16::try_from(self.schemas.len() + 1).ok()?;
        let (number, _) = self.schemas.entry(kind).or_insert_with(|| {
            let content = Content::default().u16(number).text(kind).text("ros2msg");
            let content = content.text(&schema(kind));
            record(&mut self.chunk, op::SCHEMA, &content);
            (number, content)
        });
        let content = Content::default().u16(id).u16(*number).text(topic).text("cdr").u32(0);
        record(&mut self.chunk, op::CHANNEL, &content);
        self.topics.insert(topic.to_owned(), id);
        self.channels.insert(id, Channel { content, sent: 0 });
        Some(id)
    }

    /// Closes the chunk.
    fn close(&mut self) {
        let Some((first, last)) = self.chunk_times.take() else { return };
        let records = take(&mut self.chunk);
        let (start, size) = (self.out.len() as u64, records.len() as u64);
        let mut content = Content::default().u64(first).u64(last).u64(size).u32(0).text("");
        content = content.u64(size);
        content.0.extend(records);
        record(&mut self.out, op::CHUNK, &content);
        let indexes = self.out.len() as u64;
        let mut places = Vec::new();
        for (id, messages) in take(&mut self.index) {
            places.push((id, self.out.len() as u64));
            let all = messages.into_iter();
            let all = pairs(all, |time, place| (time.to_le_bytes(), place.to_le_bytes()));
            record(&mut self.out, op::MESSAGE_INDEX, &Content::default().u16(id).list(&all));
        }
        let places = pairs(places.into_iter(), |id, at| (id.to_le_bytes(), at.to_le_bytes()));
        let content = Content::default().u64(first).u64(last).u64(start).u64(indexes - start);
        let content = content.list(&places).u64(self.out.len() as u64 - indexes);
        self.chunks.push(content.text("").u64(size).u64(size));
    }

    /// Returns the whole file.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.close();
        record(&mut self.out, op::DATA_END, &Content::default().u32(0));
        let summary = self.out.len() as u64;
        let (first, last) = self.times.unwrap_or_default();
        let sent: u64 = self.channels.values().map(|it| it.sent).sum();
        let of_each = self.channels.iter().map(|(id, it)| (*id, it.sent));
        let of_each = pairs(of_each, |id, sent| (id.to_le_bytes(), sent.to_le_bytes()));
        let schemas = u16::try_from(self.schemas.len()).unwrap_or(u16::MAX);
        let statistics = Content::default().u64(sent).u16(schemas).u32(self.channels.len());
        let statistics = statistics.u32(0).u32(0).u32(self.chunks.len()).u64(first).u64(last);
        let statistics = statistics.list(&of_each);
        let groups: [(u8, Vec<&Content>); 4] = [
            (op::SCHEMA, self.schemas.values().map(|it| &it.1).collect()),
            (op::CHANNEL, self.channels.values().map(|it| &it.content).collect()),
            (op::STATISTICS, vec![&statistics]),
            (op::CHUNK_INDEX, self.chunks.iter().collect()),
        ];
        let mut offsets = Vec::new();
        for (op, group) in groups {
            let start = self.out.len() as u64;
            group.into_iter().for_each(|it| record(&mut self.out, op, it));
            let length = self.out.len() as u64 - start;
            if length > 0 {
                let mut content = Content(vec![op]);
                content = content.u64(start).u64(length);
                record(&mut offsets, op::SUMMARY_OFFSET, &content);
            }
        }
        let footer = Content::default().u64(summary).u64(self.out.len() as u64).u32(0);
        self.out.extend(offsets);
        record(&mut self.out, op::FOOTER, &footer);
        self.out.extend(MAGIC);
        self.out
    }
}
