"""The folders of src/ as a drawing: one below the other, in the order in which they may include, with an
arc wherever one includes another, as thick as the number of includes."""
ORDER = ["io", "model", "balance", "continuation", "integration", "stability", "motion", "figures",
         "truth", "costs", "deviations", "hard", "explore", "programs"]
WIDTH, HEIGHT, STEP, REACH = 190, 24, 30, 190


def folder_of(page):
    return "programs" if page.is_program else page.key.split("/")[0]


def include_counts(pages):
    """How many files of one folder include one of another."""
    counts = {}
    for page in pages:
        for name in page.includes():
            pair = (folder_of(page), name.split("/")[0])
            if pair[0] != pair[1]:
                counts[pair] = counts.get(pair, 0) + 1
    return counts


def arc(start, end, count, present):
    """From the including folder back to the included one, right of the column of boxes."""
    y_1, y_2 = (STEP * present.index(name) + HEIGHT / 2 for name in (start, end))
    reach = WIDTH + REACH * (abs(y_1 - y_2) / (STEP * len(present))) ** 0.7 * 2
    return (f'<path d="M{WIDTH} {y_1:g} Q{reach:g} {(y_1 + y_2) / 2:g} {WIDTH} {y_2:g}" '
            f'stroke-width="{0.5 + count / 12:.2f}"><title>{start} includes {end}: {count}'
            f"</title></path>")


def folder_map(pages):
    counts = {}
    for page in pages:
        counts[folder_of(page)] = counts.get(folder_of(page), 0) + 1
    present = [name for name in ORDER if name in counts]
    if set(counts) - set(ORDER):
        raise SystemExit("no place in the map for: " + ", ".join(sorted(set(counts) - set(ORDER))))
    boxes = "".join(
        f'<rect x="0" y="{STEP * k}" width="{WIDTH}" height="{HEIGHT}" rx="4"/>'
        f'<text x="10" y="{STEP * k + 17}">{name}</text>'
        f'<text x="{WIDTH - 10}" y="{STEP * k + 17}" text-anchor="end" font-size="12">'
        f"{counts[name]} pages</text>"
        for k, name in enumerate(present))
    arcs = "".join(arc(*pair, count, present)
                   for pair, count in sorted(include_counts(pages).items())
                   if all(name in present for name in pair))
    return (f'```{{=html}}\n<div class="map"><svg role="img" viewBox="-2 -2 {WIDTH + REACH + 4} '
            f'{STEP * len(present)}" aria-label="Folders of the sources, from top to bottom: '
            f'{", ".join(present)}; each includes only folders above it">{arcs}{boxes}</svg></div>\n```')
