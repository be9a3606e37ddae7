-- What edits of sessions did here, by the random token that the session keeps until it knows: so an edit that was
-- interrupted between the two files is carried out once. `result` is the session's text.
CREATE TABLE applied_edits (
  token TEXT PRIMARY KEY,
  result TEXT NOT NULL,
  applied TEXT NOT NULL
) WITHOUT ROWID;
