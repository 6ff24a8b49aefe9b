//! A reader of MCAP files and of CDR, small and strict: it stops at whatever is not as it should.

/// A message as it was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Message {
    pub(crate) topic: String,
    pub(crate) kind: String,
    pub(crate) time_ns: u64,
    pub(crate) data: Vec<u8>,
}

/// Content of a file.
#[derive(Debug, Default)]
pub(crate) struct File {
    pub(crate) messages: Vec<Message>,
    /// Topics with their types, by number.
    pub(crate) channels: Vec<(String, String)>,
    schemas: Vec<String>,
    /// How many messages and channels it says that it has.
    pub(crate) statistics: (u64, u32),
}

/// Bytes that are read from the front.
struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, length: usize) -> &'b [u8] {
        let (taken, rest) = self.0.split_at(length);
        self.0 = rest;
        taken
    }

    fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.take(2).try_into().unwrap())
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take(4).try_into().unwrap())
    }

    fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.take(8).try_into().unwrap())
    }

    fn text(&mut self) -> String {
        let length = self.u32() as usize;
        String::from_utf8(self.take(length).to_vec()).unwrap()
    }

    /// A record: its kind and its content.
    fn record(&mut self) -> (u8, Bytes<'b>) {
        let op = self.take(1)[0];
        let length = self.u64() as usize;
        (op, Bytes(self.take(length)))
    }
}

const MAGIC: &[u8] = b"\x89MCAP0\r\n";

impl File {
    /// Reads a file from its start to its end.
    pub(crate) fn read(bytes: &[u8]) -> Self {
        let mut file = Self::default();
        let mut all = Bytes(bytes);
        assert_eq!(all.take(8), MAGIC);
        loop {
            let (op, mut content) = all.record();
            match op {
                0x01 => assert_eq!(content.text(), "ros2"),
                0x06 => file.chunk(content),
                0x0b => {
                    let messages = content.u64();
                    let _schemas = content.u16();
                    file.statistics = (messages, content.u32());
                }
                0x02 => break,
                _ => {}
            }
        }
        assert_eq!(all.0, MAGIC);
        file
    }

    /// Reads a file by the index at its end, message by message.
    pub(crate) fn read_by_index(bytes: &[u8]) -> Self {
        let mut file = Self::default();
        let mut footer = Bytes(&bytes[bytes.len() - 8 - 29..]);
        let (op, mut footer) = footer.record();
        assert_eq!(op, 0x02);
        let (summary, offsets) = (footer.u64() as usize, footer.u64() as usize);
        let mut rest = Bytes(&bytes[summary..offsets]);
        while !rest.0.is_empty() {
            let (op, content) = rest.record();
            match op {
                0x08 => file.indexed(bytes, content),
                _ => file.known(op, content),
            }
        }
        let mut groups = Bytes(&bytes[offsets..bytes.len() - 8 - 29]);
        while !groups.0.is_empty() {
            let (op, mut group) = groups.record();
            assert_eq!(op, 0x0e);
            let kind = group.take(1)[0];
            assert_eq!(bytes[group.u64() as usize], kind);
        }
        file
    }

    fn indexed(&mut self, bytes: &[u8], mut index: Bytes<'_>) {
        let (_first, _last) = (index.u64(), index.u64());
        let (start, length) = (index.u64() as usize, index.u64() as usize);
        let (op, mut chunk) = Bytes(&bytes[start..start + length]).record();
        assert_eq!(op, 0x06);
        chunk.take(8 * 3 + 4 + 4);
        let size = chunk.u64() as usize;
        let records = chunk.take(size);
        let size = index.u32() as usize;
        let mut channels = Bytes(index.take(size));
        let mut found = Vec::new();
        while !channels.0.is_empty() {
            let (id, at) = (channels.u16(), channels.u64() as usize);
            let (op, mut places) = Bytes(&bytes[at..]).record();
            assert_eq!((op, places.u16()), (0x07, id));
            let size = places.u32() as usize;
            let mut places = Bytes(places.take(size));
            while !places.0.is_empty() {
                let (time, place) = (places.u64(), places.u64() as usize);
                let (op, content) = Bytes(&records[place..]).record();
                let message = self.message(op, content);
                assert_eq!(message.time_ns, time);
                found.push((place, message));
            }
        }
        found.sort_by_key(|it| it.0);
        self.messages.extend(found.into_iter().map(|it| it.1));
    }

    fn chunk(&mut self, mut content: Bytes<'_>) {
        let (first, last, size) = (content.u64(), content.u64(), content.u64());
        assert_eq!((content.u32(), content.text().as_str()), (0, ""));
        assert_eq!(content.u64(), size);
        let before = self.messages.len();
        while !content.0.is_empty() {
            let (op, content) = content.record();
            if op == 0x05 {
                let message = self.message(op, content);
                self.messages.push(message);
            } else {
                self.known(op, content);
            }
        }
        let times = || self.messages[before..].iter().map(|it| it.time_ns);
        assert_eq!((times().min(), times().max()), (Some(first), Some(last)));
    }

    fn message(&self, op: u8, mut content: Bytes<'_>) -> Message {
        assert_eq!(op, 0x05);
        let (topic, kind) = self.channels[content.u16() as usize].clone();
        let _sequence = content.u32();
        let (time_ns, published) = (content.u64(), content.u64());
        assert_eq!(time_ns, published);
        Message { topic, kind, time_ns, data: content.0.to_vec() }
    }

    /// Learns a type or a channel, in the order of their numbers.
    fn known(&mut self, op: u8, mut content: Bytes<'_>) {
        match op {
            0x03 => {
                let number = content.u16() as usize;
                let (name, encoding) = (content.text(), content.text());
                assert_eq!(encoding, "ros2msg");
                assert!(!content.text().is_empty());
                self.schemas.resize(self.schemas.len().max(number), String::new());
                self.schemas[number - 1] = name;
            }
            0x04 => {
                assert_eq!(content.u16() as usize, self.channels.len());
                let schema = content.u16() as usize;
                let topic = content.text();
                assert_eq!(content.text(), "cdr");
                self.channels.push((topic, self.schemas[schema - 1].clone()));
            }
            _ => {}
        }
    }

    /// The messages of a topic.
    pub(crate) fn of<'f>(&'f self, topic: &'f str) -> impl Iterator<Item = &'f Message> {
        self.messages.iter().filter(move |it| it.topic == topic)
    }

    /// The topics.
    pub(crate) fn topics(&self) -> impl Iterator<Item = &str> {
        self.channels.iter().map(|it| it.0.as_str())
    }
}

/// A message that is read value by value.
pub(crate) struct Cdr<'d> {
    data: &'d [u8],
    at: usize,
}

impl<'d> Cdr<'d> {
    pub(crate) fn of(message: &'d [u8]) -> Self {
        assert_eq!(message[..4], [0, 1, 0, 0]);
        Self { data: &message[4..], at: 0 }
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        let start = self.at.next_multiple_of(N);
        self.at = start + N;
        self.data[start..self.at].try_into().unwrap()
    }

    pub(crate) fn u8(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    pub(crate) fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    pub(crate) fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    pub(crate) fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    pub(crate) fn bytes(&mut self) -> &'d [u8] {
        let length = self.u32() as usize;
        self.at += length;
        &self.data[self.at - length..self.at]
    }

    pub(crate) fn text(&mut self) -> String {
        let (zero, text) = self.bytes().split_last().unwrap();
        assert_eq!(*zero, 0);
        String::from_utf8(text.to_vec()).unwrap()
    }

    pub(crate) fn is_at_end(&self) -> bool {
        self.at == self.data.len()
    }
}
