-- From where each fragment was seen: cells of ViewCoverage, cell i in bit i % 8 of byte i / 8; no bytes: from nowhere.
ALTER TABLE fragments ADD COLUMN seen_from BLOB NOT NULL DEFAULT x'';
