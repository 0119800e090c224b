//! The noise of a picture, estimated while it is rendered.
