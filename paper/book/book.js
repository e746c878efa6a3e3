DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = location.protocol !== "file:";  // a file may not read others; what scrolls takes the keyboard
addEventListener("DOMContentLoaded", () => document.querySelectorAll("pre, .math, .table-wrapper").forEach((part) => { part.tabIndex = 0; }));
