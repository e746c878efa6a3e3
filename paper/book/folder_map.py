"""The folders of src/ as a drawing: a column each, in the order in which they may include, with an
arrow wherever one includes another, as thick as the number of includes."""
ORDER = ["io", "model", "balance", "continuation", "integration", "stability", "motion", "figures",
         "truth", "costs", "studies", "deviations", "hard", "explore", "programs"]
WIDTH, STEP, TOP, HEIGHT = 98, 104, 196, 40


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


def arc(start, end, count):
    """From the including folder back to the included one, above the row of boxes."""
    x_1, x_2 = (STEP * ORDER.index(name) + WIDTH / 2 for name in (start, end))
    lift = TOP - 16 * abs(ORDER.index(start) - ORDER.index(end)) - 8
    return (f'<path d="M{x_1:g} {TOP} Q{(x_1 + x_2) / 2:g} {lift - 20:g} {x_2:g} {TOP}" '
            f'stroke-width="{0.5 + count / 12:.2f}"><title>{start} includes {end}: {count}'
            f"</title></path>")


def folder_map(pages):
    counts = {}
    for page in pages:
        counts[folder_of(page)] = counts.get(folder_of(page), 0) + 1
    present = [name for name in ORDER if name in counts]
    boxes = "".join(
        f'<rect x="{STEP * ORDER.index(name)}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" rx="4"/>'
        f'<text x="{STEP * ORDER.index(name) + WIDTH / 2:g}" y="{TOP + 18}" '
        f'text-anchor="middle">{name}</text>'
        f'<text x="{STEP * ORDER.index(name) + WIDTH / 2:g}" y="{TOP + 34}" '
        f'text-anchor="middle" font-size="12">{counts[name]} pages</text>'
        for name in present)
    arcs = "".join(arc(*pair, count) for pair, count in sorted(include_counts(pages).items())
                   if all(name in present for name in pair))
    return (f'```{{=html}}\n<div class="map"><svg role="img" viewBox="-2 -2 {STEP * len(ORDER)} {TOP + HEIGHT + 6}" '
            f'aria-label="Folders of the sources, from left to right: '
            f'{", ".join(present)}; each includes only folders to its left">{arcs}{boxes}</svg></div>\n```')
