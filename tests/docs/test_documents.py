"""Links, menus, messages and pictures of the documents fit the sources. Commands are checked by command_line_tests."""

import unittest

import documents

LARGEST_PICTURE = 150_000
ALL_PICTURES = 1_500_000


class Links(unittest.TestCase):
    def test_lead_to_files_and_headings(self):
        made = documents.made_pictures()
        for file in documents.documents():
            faults = documents.broken_links(file.read_text("utf-8"), file, made)
            self.assertEqual(faults, [], file)

    def test_are_reported_when_broken(self):
        file = documents.ROOT / "docs" / "user-guide.md"
        text = (
            "# One\n[a](no-such-file.md) [b](#two) [c](#one) [d](https://example.org) [e](formats.md#no-such-heading)\n"
            "[f](formats.md) `[g](no.md)`\n\n    [h](no.md)\n\n![i](no.png)\n"
        )
        self.assertEqual(
            documents.broken_links(text, file), ["no-such-file.md", "#two", "formats.md#no-such-heading", "no.png"]
        )


class Menus(unittest.TestCase):
    def test_are_texts_of_the_window(self):
        texts = documents.window_texts()
        self.assertGreater(len(texts), 300)
        for file in documents.documents():
            self.assertEqual(documents.unknown_menus(file.read_text("utf-8"), texts), [], file)

    def test_are_reported_when_unknown(self):
        texts = documents.window_texts()
        text = "***File > Export data set*** ***File > Fold\nlaundry*** *File > Nothing* `***File > Code***`"
        self.assertEqual(documents.unknown_menus(text, texts), ["Fold laundry"])


class Messages(unittest.TestCase):
    def test_are_texts_of_the_program(self):
        page = (documents.GUIDE / "problems.md").read_text("utf-8")
        self.assertEqual(documents.unknown_messages(page, documents.source_texts()), [])

    def test_are_reported_when_unknown(self):
        page = "| `The folder … is empty.` | a |\n| `The folder … is on fire.` | b |\n| word | c |\n"
        self.assertEqual(
            documents.unknown_messages(page, documents.source_texts()), ["The folder … is on fire."]
        )


class Guide(unittest.TestCase):
    def test_lists_all_its_pages(self):
        index = (documents.GUIDE / "index.md").read_text("utf-8")
        listed = [line.strip() for line in index.splitlines()]
        for page in documents.GUIDE.glob("*.md"):
            if page.stem != "index":
                self.assertIn(page.stem, listed)
        for page in (documents.ROOT / "docs").glob("*.md"):
            self.assertIn(f"../{page.stem}", listed)

    def test_shows_the_pictures_that_its_script_makes(self):
        self.assertEqual(documents.shown_pictures(), documents.made_pictures())

    def test_has_small_pictures(self):
        sizes = {file.name: file.stat().st_size for file in documents.GUIDE.glob("pictures/*")}
        self.assertEqual([name for name, size in sizes.items() if size > LARGEST_PICTURE], [])
        self.assertLessEqual(sum(sizes.values()), ALL_PICTURES)


if __name__ == "__main__":
    unittest.main()
