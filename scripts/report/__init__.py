"""The parts of scripts/loop_report: a loop's numbers (result), in words (words), in pictures
(pictures, theme), on a page (page, page.html)."""
