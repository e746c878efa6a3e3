// From the file system a page may not read others: the search shows titles alone. What scrolls can be reached by the keyboard.
DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = location.protocol !== "file:";
addEventListener("DOMContentLoaded", () => document.querySelectorAll("pre, .math, .table-wrapper").forEach((part) => { part.tabIndex = 0; }));
