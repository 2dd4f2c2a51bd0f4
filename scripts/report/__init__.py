"""The parts of scripts/result_report: the studies of a result (stored), what each kind has (kinds), its pictures (a
module each; theme, picture), a loop's own numbers and words (result, loop, words), all on a page (page, page.html)."""
