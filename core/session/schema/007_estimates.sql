-- Labels at estimated places, where no depth image shows the surface: bricks of EstimatedLabels. `cells`: its words, 32 bits
-- each.
CREATE TABLE estimates (
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  cells BLOB NOT NULL,
  row_check INTEGER,
  PRIMARY KEY (x, y, z)
) WITHOUT ROWID;
