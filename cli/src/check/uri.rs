//! Paths as references of the web.

use std::fmt::Write;

/// A path as a URI reference (RFC 3986): a relative one as a relative reference, an absolute one as
/// a `file` URI. Each byte of its UTF-8 that could mean something else is percent-encoded. On
/// Windows a backslash separates folders, and a path may begin with a drive or a server.
pub(super) fn reference(path: &str, windows: bool) -> String {
    let path = if windows { path.replace('\\', "/") } else { path.to_owned() };
    let is_letter = u8::is_ascii_alphabetic;
    let drive = |it: &str| matches!(it.as_bytes(), [letter, b':', b'/', ..] if is_letter(letter));
    if windows && drive(&path) {
        return format!("file:///{}{}", &path[..2], encoded(&path[2..]));
    }
    if windows && path.starts_with("//") {
        return format!("file:{}", encoded(&path));
    }
    if path.starts_with('/') {
        return format!("file://{}", encoded(&path));
    }
    // Before a colon in its first segment a reader would see a scheme.
    let first = path.split('/').next().unwrap_or_default();
    let lead = if first.contains(':') { "./" } else { "" };
    format!("{lead}{}", encoded(&path))
}

fn encoded(path: &str) -> String {
    let mut text = String::with_capacity(path.len());
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/:@+,=".contains(&byte) {
            text.push(byte.into());
        } else {
            let _ = write!(text, "%{byte:02X}"); // a String takes everything
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::reference;

    #[test]
    fn reserved_characters_of_a_uri_are_encoded_by_their_bytes() {
        for (path, uri) in [
            ("robot.pnml", "robot.pnml"),
            ("my nets/robot #2.pnml", "my%20nets/robot%20%232.pnml"),
            ("Tür/größe.net", "T%C3%BCr/gr%C3%B6%C3%9Fe.net"),
            ("100%/a?b.json", "100%25/a%3Fb.json"),
            ("a%20b", "a%2520b"),
            ("[x]{y}|z^`\"<>", "%5Bx%5D%7By%7D%7Cz%5E%60%22%3C%3E"),
            ("日本/🤖.net", "%E6%97%A5%E6%9C%AC/%F0%9F%A4%96.net"),
            ("a\\b\u{1b}\u{202e}", "a%5Cb%1B%E2%80%AE"),
            ("../x/./y", "../x/./y"),
        ] {
            assert_eq!(reference(path, false), uri);
        }
    }

    #[test]
    fn a_colon_in_the_first_segment_is_no_scheme() {
        for (path, uri) in [
            ("c:x", "./c:x"),
            ("http:/y", "./http:/y"),
            ("a/c:x", "a/c:x"),
            ("./c:x", "./c:x"),
            (":", "./:"),
        ] {
            assert_eq!(reference(path, false), uri);
        }
    }

    #[test]
    fn an_absolute_path_is_a_file_uri() {
        for (path, windows, uri) in [
            ("/home/me/a b.net", false, "file:///home/me/a%20b.net"),
            ("//odd", false, "file:////odd"),
            ("C:\\my nets\\a.net", true, "file:///C:/my%20nets/a.net"),
            ("\\\\server\\share\\a.net", true, "file://server/share/a.net"),
            ("nets\\a.net", true, "nets/a.net"),
            ("c:x", true, "./c:x"),
        ] {
            assert_eq!(reference(path, windows), uri);
        }
    }
}
