"""Tests of the checks, without scanners and servers."""
import unittest

import agreement
from private_server import seconds_of


def event(number, action, one, **after):
    return {"id": number, "action": action, "object": one, "after": after}


def state(name, **changes):
    return {"name": name, "hidden": False, "merged_into": None, "confirmed": False, "named_by_person": False, **changes}


HISTORY = [event(1, "add", 1, name="Obj_1"), event(2, "add", 2, name="Obj_2"), event(3, "add", 3, name="Obj_3"),
           event(4, "add-view", 3, view=3), event(5, "rename", 1, **state("mug", named_by_person=True)),
           event(6, "merge", 2, **state("Obj_2", hidden=True, merged_into=1)),
           event(7, "remove", 3, **state("Obj_3", hidden=True))]


def rows(**changes):
    objects = [{"id": one, "number": one, **told} for one, told in agreement.replay(HISTORY).items()]
    objects.append({"id": 4, "number": -1, **state("Discarded views", hidden=True)})
    objects[0].update(changes)
    return objects


class AgreementTest(unittest.TestCase):
    def test_finds_edits_that_are_not_in_the_history(self):
        edits = [{"kind": "rename", "objects": [1], "name": "mug", "is_done": True},
                 {"kind": "merge", "objects": [1, 2], "name": None, "is_done": True},
                 {"kind": "delete", "objects": [3], "name": None, "is_done": True},
                 {"kind": "rename", "objects": [1], "name": "refused", "is_done": False}]
        self.assertEqual(agreement.missing_edits(edits, HISTORY), [])
        for number, lost in enumerate((5, 6, 7)):
            kept = [one for one in HISTORY if one["id"] != lost]
            self.assertEqual(len(agreement.missing_edits(edits, kept)), 1, edits[number])

    def test_finds_rows_that_the_history_does_not_tell(self):
        self.assertEqual(agreement.differences(HISTORY, rows()), [])
        self.assertEqual(len(agreement.differences(HISTORY, rows(name="Obj_1"))), 1)
        self.assertEqual(len(agreement.differences(HISTORY, rows()[1:])), 1)
        of_others = [one for one in HISTORY if one["object"] != 1]
        self.assertEqual(agreement.differences(of_others, rows()), ["object 1 is not in the history"])

    def test_finds_objects_that_nobody_hid(self):
        self.assertEqual(agreement.lost_objects(HISTORY, rows()), [])
        self.assertEqual(agreement.lost_objects(HISTORY[:-1], rows()), [3])

    def test_compares_reports_with_moments(self):
        moments = [agreement.replay(HISTORY[:4]), agreement.replay(HISTORY)]
        self.assertEqual(agreement.disagreements("a", [{"id": 1, "name": "mug", "confirmed": False}], moments), [])
        self.assertEqual(agreement.disagreements("a", [{"id": 1, "name": "Obj_1", "confirmed": False}], moments), [])
        for one in ({"id": 1, "name": "cup", "confirmed": False}, {"id": 9, "name": "mug", "confirmed": False}):
            self.assertEqual(len(agreement.disagreements("a", [one], moments)), 1)

    def test_measures_from_the_commit_to_the_reading_that_brought_it(self):
        read = "SELECT id, action, object, before_json, after_json FROM events WHERE id > "
        insert = """INSERT INTO events VALUES ('rename', 1, '{"name":"Obj_1"}', '{"name":"mug"}')"""
        statements = [(1.0, 8, read + "4"), (2.0, 7, "BEGIN"), (2.1, 7, insert), (2.2, 7, "COMMIT"),
                      (2.25, 9, read + "4"), (2.3, 8, read + "4"), (2.9, 9, read + "4"), (3.3, 8, read + "5"),
                      (3.9, 9, read + "6")]
        delays = agreement.delays(statements, {"mug": 5})
        self.assertEqual([(moment, round(delay, 6)) for moment, delay in delays], [(2.2, 0.1), (2.2, 0.7)])

    def test_reads_the_time_of_the_log(self):
        self.assertAlmostEqual(seconds_of("1970-01-02 00:01:01.250 UTC"), 86461.25)


if __name__ == "__main__":
    unittest.main()
