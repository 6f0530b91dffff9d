SELECT a.*, b.* FROM doors a, doors b, doors c ORDER BY random()
