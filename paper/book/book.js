/* The search box of the index: every word must occur in the page's title, name or text. */
"use strict";
const box = document.querySelector(".search");
const list = document.querySelector("#found");

function matches(page, words) {
  const text = (page.title + " " + page.name + " " + page.text).toLowerCase();
  return words.every((word) => text.includes(word));
}

function excerpt(page, word) {
  const at = page.text.toLowerCase().indexOf(word);
  if (at < 0) return "";
  return "… " + page.text.slice(Math.max(0, at - 60), at + 100) + " …";
}

function entry(page, words) {
  const item = document.createElement("li");
  const link = document.createElement("a");
  link.href = page.file;
  link.textContent = page.title;
  item.append(link, " ", excerpt(page, words[0]));
  return item;
}

function search() {
  const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = words.length ? pages.filter((page) => matches(page, words)) : [];
  list.replaceChildren(...found.map((page) => entry(page, words)));
  document.querySelector("#count").textContent =
    words.length ? found.length + " of " + pages.length + " pages" : "";
}

if (box) box.addEventListener("input", search);
