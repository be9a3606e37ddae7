"""Which painted masks of a session hold, as the program sees them (core/session/mask_corrections.cpp)."""

import json


def painted_operations(database):
    """(number of the operation, key frame, region) of each painted mask that holds, oldest first.

    A mask holds unless it was undone, or a later operation took back what was painted for its region in that image.
    """
    rows = database.execute("SELECT number, operation, effect FROM operations WHERE state = 'done' ORDER BY number")
    done = [(row[0], json.loads(row[1]), json.loads(row[2] or "{}")) for row in rows]
    region_of = dict(database.execute("SELECT fragment, region FROM fragments").fetchall())
    present = set(region_of.values())

    def now(operation, effect):
        """The region of an operation as it is now; None: nothing is left of it."""
        region = _region_then(operation, effect)
        return region if region in present else region_of.get(effect.get("anchor"))

    def is_taken_back(index):
        _, painted, effect = done[index]
        region = now(painted, effect)
        for later in range(index + 1, len(done)):
            _, operation, its_effect = done[later]
            if operation["kind"] != "unpaint" or _key_frame(operation) != _key_frame(painted):
                continue
            if region is None or now(operation, its_effect) != region:
                continue
            # A later join does not take back what the joined region had.
            after = [one[2] for one in done[later + 1 :]]
            if _region_before(effect, region, after) == _region_before(its_effect, region, after):
                return True
        return False

    return [
        (number, _key_frame(operation), _region_then(operation, effect))
        for index, (number, operation, effect) in enumerate(done)
        if operation["kind"] == "paint" and not is_taken_back(index)
    ]


def _key_frame(operation):
    return operation["mask"]["key_frame"]


def _region_then(operation, effect):
    """The region that was painted for: a new one, or the one that the operation names."""
    is_new = operation.get("mask", {}).get("makes_region", False)
    return effect["created"][0] if is_new and effect.get("created") else operation["regions"][0]


def _region_before(effect, region, later_effects):
    """The region that the anchor of an effect was in before later ones, after which it is in `region`."""
    for later in reversed(later_effects):
        for fragment, before, after in later.get("moves", []):
            if fragment == effect.get("anchor") and after == region:
                region = before
                break
    return region
