// Pages opened from the file system may not read each other: the search shows titles alone.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
// What scrolls can be reached by the keyboard.
document.addEventListener("DOMContentLoaded", () => document.querySelectorAll("pre, .math, .table-wrapper").forEach((part) => { part.tabIndex = 0; }));
