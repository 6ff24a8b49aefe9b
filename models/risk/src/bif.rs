//! Networks in BIF, the interchange format of 1998, as published files have it: rows in any order,
//! commas and bars as white space, `default`, flat tables, properties, comments; and in XMLBIF.

mod lexer;
mod read;
mod write;
mod xml;
