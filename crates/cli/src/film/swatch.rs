//! Colours in a terminal.

use std::io::IsTerminal;

/// A swatch in the colour itself on a terminal that shows colours, else nothing. <https://no-color.org> is heeded.
pub(crate) fn swatch([r, g, b]: [u8; 3]) -> String {
    if shows_colours() {
        format!("\x1b[48;2;{r};{g};{b}m      \x1b[0m ")
    } else {
        String::new()
    }
}

fn shows_colours() -> bool {
    let asks_for_none = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let cannot = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    std::io::stdout().is_terminal() && !asks_for_none && !cannot
}
