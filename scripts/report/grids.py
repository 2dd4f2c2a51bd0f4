"""Pictures of a grid: how near its stages come, which values they keep, and what matters in each."""
import numpy as np

from report import theme
from report.picture import Table, bare_unit, picture, short, unit_words
from report.screening import spread
from report.stored import join
from report.words import fixed, listed, number

MOST_DOTS = 600
SHOWN = 3                      # errors are drawn up to so many times the neighbours' largest


def stages_of(study):
    """Groups of the stages, in their order."""
    groups = [group for group in study.groups_with("target_error", "neighbour", "grid_points")
              if study.knows(join(group, "target_error"))]
    return sorted(groups, key=lambda group: (len(group), group))


def neighbours(study, group):
    points = study.numbers(join(group, "grid_points"))
    kept = study.numbers(join(group, "neighbour")).astype(int)
    return kept[(kept >= 0) & (kept < len(points))]


def progress(study):
    """Distance of each stage's nearest point, and how many points it took."""
    distance, points = study.numbers("stage_distance"), study.numbers("stage_points")
    figure, axis = theme.figure(2.2)
    stage = np.arange(1, distance.size + 1)
    axis.plot(stage, distance, "o-", color=theme.AFTER, markersize=5)
    wanted = study.number("target_error_wanted")
    if wanted > 0:
        axis.axhline(wanted, color=theme.SOFT, linewidth=0.8, linestyle=":")
    unit = "%" if study.text("grid_distance") == "euclidean" else "1"
    axis.set(xlabel="stage, and how many points it took", ylabel=f"distance{unit_words(unit)}",
             xlim=(0.5, max(distance.size, 1) + 0.5))
    axis.set_xticks(stage, [f"{s}\n{number(n)}" for s, n in zip(stage, points)])
    axis.set_ylim(0, 1.2 * max(np.nanmax(distance), wanted if wanted > 0 else 0, 1e-12))
    aim = " Dotted: the error at which it ends." if wanted > 0 else ""
    said = listed(f"{fixed(value, 3)} in stage {s}" for s, value in zip(stage, distance))
    yield picture(figure, "Nearest point of each stage", f"Distance of the nearest point: {said}.",
                  f"Ended: {study.text('ended_by')}.{aim}")


def errors(study):
    """Errors of the first two targets of the points that come near, the neighbours marked."""
    targets = study.texts("target")
    groups = stages_of(study)
    if len(targets) < 2 or not groups:
        return
    kept = [study.numbers(join(group, "target_error"))[neighbours(study, group)] for group in groups]
    reach = SHOWN * max(np.nanmax(np.abs(errors[:, :2])) for errors in kept if errors.size)
    figure, axis = theme.figure(2.9)
    for group in groups:
        points = study.numbers(join(group, "target_error"))
        near = spread((np.abs(points[:, :2]) <= reach).all(axis=1), MOST_DOTS)
        theme.dots(axis, points[near, 0], points[near, 1], theme.PLAIN, alpha=0.5, size=2,
                   label="points" if group == groups[0] else None)
    for k, (group, rows) in enumerate(zip(groups, kept)):
        last = k == len(groups) - 1
        axis.scatter(rows[:, 0], rows[:, 1], s=24 if last else 12, color=theme.AFTER if last else theme.BEFORE,
                     label="nearest, last stage" if last else ("nearest, before" if k == 0 else None), zorder=3)
    axis.axhline(0, color=theme.SOFT, linewidth=0.8)
    axis.axvline(0, color=theme.SOFT, linewidth=0.8)
    axis.set(xlabel=f"error of {short(targets[0])} [%]", ylabel=f"of {short(targets[1])} [%]")
    theme.legend_above(axis)
    best = kept[-1][0] if len(kept[-1]) else np.full(2, np.nan)
    yield picture(figure, "Errors of the points",
                  f"Errors of {targets[0]} and {targets[1]} of the points near the measured values; the nearest of "
                  f"the last stage has {fixed(best[0], 2)} % and {fixed(best[1], 2)} %.",
                  "Simulated minus measured. The measured building is where the lines cross.")


def values(study):
    """Values that each stage tried, and those that its neighbours keep."""
    names, units = study.texts("parameter"), study.texts("parameter_unit")
    groups = stages_of(study)
    if not groups:
        return
    figure, axes = theme.panels(len(names), 2, 0.6 + 0.2 * len(groups), sharey=True)
    for p, (axis, name) in enumerate(zip(axes, names)):
        for row, group in enumerate(groups, start=1):
            tried = study.numbers(join(group, "grid_value"))[study.numbers(join(group, "grid_parameter")) == p]
            kept = np.unique(study.numbers(join(group, "grid_points"))[neighbours(study, group), p])
            axis.scatter(tried, np.full(tried.size, row), s=12, facecolor="none", edgecolor=theme.PLAIN, linewidth=0.8)
            axis.scatter(kept, np.full(kept.size, row), s=14, color=theme.AFTER)
        axis.set_xlabel(f"{short(name)}{unit_words(units[p] if p < len(units) else '')}")
        axis.grid(False, axis="y")
        axis.locator_params(axis="x", nbins=5)
        theme.compact(axis)
    axes[0].set(yticks=range(1, len(groups) + 1), ylim=(len(groups) + 0.5, 0.5))
    for axis in axes[::2]:
        axis.set_ylabel("stage")
    roles = study.texts(join(groups[-1], "parameter_role"))
    yield picture(figure, "Values tried and kept",
                  f"Values of the parameters in each of {len(groups)} stages; in the end: "
                  f"{listed(f'{name} {role}' for name, role in zip(names, roles))}.",
                  "Circles: tried; dots: kept by the nearest points.")


def roles(study):
    """What became of each parameter."""
    groups = stages_of(study)
    columns = [study.texts(join(group, "parameter_role")) for group in groups]
    names, units = study.texts("parameter"), study.texts("parameter_unit")
    nearest = study.numbers("nearest_parameters")
    rows = [[name, number(nearest[p], 4) if p < nearest.size else "", bare_unit(units[p]),
             *(column[p] if p < len(column) else "" for column in columns)] for p, name in enumerate(names)]
    yield Table("Nearest point, and what became of the parameters",
                [("parameter", False), ("nearest point", True), ("unit", False),
                 *((f"stage {k + 1}", False) for k in range(len(groups)))], rows)
    yield "Open: several values of the parameter are among the nearest points. Determined: one is, and the parameter " \
          "matters. Insensitive: one is, but the parameter hardly matters. Held: it had one value from the start."


def indices(study):
    """Total-order index of the distance in each stage."""
    names, groups = study.texts("parameter"), stages_of(study)
    cells = [study.numbers(join(group, "distance_total_order")) for group in groups]
    if not cells or any(row.shape != (len(names),) for row in cells) or not np.isfinite(cells).any():
        return
    cells = np.array(cells).T
    figure, axis = theme.figure(0.9 + 0.26 * len(names))
    axis.imshow(np.nan_to_num(cells), cmap=theme.rising(), vmin=0, vmax=1, aspect="auto", interpolation="nearest")
    for p, stage in zip(*np.nonzero(np.isfinite(cells))):
        axis.text(stage, p, fixed(cells[p, stage], 2), ha="center", va="center", fontsize=7)
    axis.set_yticks(range(len(names)), [short(name) for name in names])
    axis.set_xticks(range(len(groups)), [str(k + 1) for k in range(len(groups))])
    axis.set_xlabel("stage")
    axis.grid(False)
    p, stage = np.unravel_index(np.nanargmax(np.nan_to_num(cells)), cells.shape)
    yield picture(figure, "What matters for the distance",
                  f"Total-order indices of the distance by stage: the largest is {names[p]} with "
                  f"{fixed(cells[p, stage], 2)} in stage {stage + 1}.",
                  "Share of the distance's variance over each stage's own grid, with interactions (total-order index).")
