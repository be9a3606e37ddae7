"""Whether a catalogue holds all that was answered with success, and agrees with its own history."""
import re

STATE = ("name", "hidden", "merged_into", "confirmed", "named_by_person")
READS_CHANGES = re.compile(r"SELECT id, action, object, before_json, after_json FROM events WHERE id > '?(\d+)")
NAME = re.compile(r'"name":"([^"]*)"')


def missing_edits(edits, events):
    """Edits that were answered with success, and are no event. `events`: rows with parsed `after`."""
    renames = {event["after"].get("name") for event in events if event["action"] == "rename"}
    removed = {event["object"] for event in events if event["action"] == "remove"}
    merged = {frozenset((event["object"], event["after"].get("merged_into")))
              for event in events if event["action"] == "merge"}
    missing = []
    for edit in edits:
        if not edit["is_done"]:
            continue
        found = {"rename": edit["name"] in renames,
                 "delete": edit["objects"][0] in removed,
                 "merge": frozenset(edit["objects"]) in merged}[edit["kind"]]
        if not found:
            missing.append(f"{edit['kind']} {edit['objects']} {edit['name'] or ''}".strip())
    return missing


def replay(events):
    """The state of each object as its events tell it."""
    states = {}
    for event in events:
        if event["action"] == "add":
            states[event["object"]] = {"name": event["after"]["name"], "hidden": False, "merged_into": None,
                                       "confirmed": False, "named_by_person": False}
        elif "name" in event["after"] and event["object"] is not None:
            states[event["object"]] = {key: event["after"].get(key) for key in STATE}
    return states


def differences(events, objects):
    """Where the rows of `objects` are not what the events tell. Objects of discarded views have no events."""
    states = replay(events)
    rows = {row["id"]: row for row in objects if row["number"] > 0}
    found = [f"object {one} of the history is not in the catalogue" for one in states.keys() - rows.keys()]
    found += [f"object {one} is not in the history" for one in rows.keys() - states.keys()]
    for one in states.keys() & rows.keys():
        for key in STATE:
            told, stored = states[one][key], rows[one][key]
            if isinstance(told, bool):
                stored = bool(stored)
            if told != stored:
                found.append(f"object {one}: {key} is {stored}, the history says {told}")
    return found


def lost_objects(events, objects):
    """Hidden objects that nobody deleted or merged."""
    explained = {event["object"] for event in events if event["action"] in ("remove", "merge")}
    return [row["id"] for row in objects if row["hidden"] and row["number"] > 0 and row["id"] not in explained]


def disagreements(scanner, reported, moments):
    """Objects of a scanner's report that the catalogue had otherwise. `moments`: the states of all objects at the moments
    that the report may be of."""
    found = []
    for one in reported:
        told = [states.get(one["id"]) for states in moments]
        if any(state and not state["hidden"] and (state["name"], state["confirmed"]) == (one["name"], one["confirmed"])
               for state in told):
            continue
        found.append(f"{scanner}: object {one['id']} \"{one['name']}\" is in the catalogue {told[-1]}")
    return found


def delays(statements, renames):
    """(moment, seconds) of each rename and scanner: the commit, and how long after it the scanner has read it. `statements`: (time, process, text), by the
    time of their ends. `renames`: the ids of their events by name. A scanner reads changes again and again."""
    pending, commits, readings = {}, [], {}
    for moment, process, text in statements:
        if text.startswith("BEGIN"):
            pending.pop(process, None)
        elif text.startswith("INSERT INTO events") and "'rename'" in text:
            pending[process] = renames.get(NAME.findall(text)[-1])
        elif text.startswith("COMMIT"):
            if event := pending.pop(process, None):
                commits.append((moment, event))
        elif found := READS_CHANGES.match(text):
            readings.setdefault(process, []).append((moment, int(found[1])))
    result = []
    for moment, event in commits:
        for reads in readings.values():
            # A reading has brought the event if the next one goes on after it.
            brought = next((read[0] for read, later in zip(reads, reads[1:]) if read[1] < event <= later[1]), None)
            if brought is not None:
                result.append((moment, max(0.0, brought - moment)))
    return result
