-- `class` and `key` behind the documented columns reach one object's conclusions by key; `object` joins them.
CREATE VIEW conclusions AS
SELECT c.class || '.' || c.key AS object, c.property AS property, c.value AS value, u.name AS rule,
       u.version AS version, w.facts AS witness, c.class AS class, c.key AS key, u.file AS file, u.line AS line
FROM (
  SELECT 'prime_areas' AS class, area AS key, 'open' AS property, open AS value, open_rule AS rule, open_witness AS witness
    FROM prime_area_strips WHERE open_rule IS NOT NULL
  UNION ALL SELECT 'rooms', room, 'hardness', hardness, hardness_rule, hardness_witness
    FROM rooms WHERE hardness_rule IS NOT NULL
  UNION ALL SELECT 'rooms', room, 'action', action, action_rule, action_witness
    FROM rooms WHERE action_rule IS NOT NULL
  UNION ALL SELECT 'rooms', room, 'passable', passable, passable_rule, passable_witness
    FROM rooms WHERE passable_rule IS NOT NULL
  UNION ALL SELECT 'doors', door, 'hardness', hardness, hardness_rule, hardness_witness
    FROM doors WHERE hardness_rule IS NOT NULL
  UNION ALL SELECT 'doors', door, 'action', action, action_rule, action_witness
    FROM doors WHERE action_rule IS NOT NULL
  UNION ALL SELECT 'doors', door, 'passable', passable, passable_rule, passable_witness
    FROM doors WHERE passable_rule IS NOT NULL
  UNION ALL SELECT class, key, property, value, rule, witness FROM derivations
) AS c
LEFT JOIN rules AS u ON u.rule = c.rule
LEFT JOIN witnesses AS w ON w.witness = c.witness;
