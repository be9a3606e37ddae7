-- How likely each region was one complete object when the scan was refined last: log-odds, the mean of several key frames.
-- Regions that no key frame shows well have no row.
CREATE TABLE objectness (
  region INTEGER PRIMARY KEY,
  log_odds REAL NOT NULL,
  row_check INTEGER
);
