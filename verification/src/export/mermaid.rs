//! Mermaid diagrams.
