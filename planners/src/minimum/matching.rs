//! Largest matchings and independent sets of bipartite graphs (Hopcroft and Karp 1973; König 1931).
//!
//! petgraph finds such matchings, too, by `dinics`; but it looks at all vertices anew for each path that it grows.

/// A bipartite graph: for each left vertex its neighbours on the right.
pub(super) struct Graph {
    pub(super) left: Vec<Vec<u32>>,
    pub(super) right_count: usize,
}

const NOBODY: u32 = u32::MAX;

/// Partners on either side, `NOBODY` where there is none.
struct Matching {
    of_left: Vec<u32>,
    of_right: Vec<u32>,
}

/// Which left and which right vertices belong to one largest set without neighbours.
pub(super) fn largest_independent_set(graph: &Graph) -> (Vec<bool>, Vec<bool>) {
    let matching = largest_matching(graph);
    // What alternating paths from unmatched left vertices reach: König's theorem.
    let mut left_reached: Vec<_> = matching.of_left.iter().map(|&partner| partner == NOBODY).collect();
    let mut right_reached = vec![false; graph.right_count];
    let mut waiting: Vec<_> = (0..graph.left.len()).filter(|&left| left_reached[left]).collect();
    while let Some(left) = waiting.pop() {
        for &right in &graph.left[left] {
            if !std::mem::replace(&mut right_reached[right as usize], true) {
                let partner = matching.of_right[right as usize] as usize;
                if partner != NOBODY as usize && !std::mem::replace(&mut left_reached[partner], true) {
                    waiting.push(partner);
                }
            }
        }
    }
    (left_reached, right_reached.into_iter().map(|reached| !reached).collect())
}

fn largest_matching(graph: &Graph) -> Matching {
    let mut matching =
        Matching { of_left: vec![NOBODY; graph.left.len()], of_right: vec![NOBODY; graph.right_count] };
    while let Some(depths) = depths_of_shortest_paths(graph, &matching) {
        let mut tried = vec![0; graph.left.len()];
        for left in 0..graph.left.len() as u32 {
            if matching.of_left[left as usize] == NOBODY {
                augment(graph, &mut matching, &depths, &mut tried, left);
            }
        }
    }
    matching
}

/// For each left vertex how many matched edges away it is from an unmatched one; `None` if no alternating path ends
/// at an unmatched right vertex.
fn depths_of_shortest_paths(graph: &Graph, matching: &Matching) -> Option<Vec<u32>> {
    let mut depths = vec![NOBODY; graph.left.len()];
    let unmatched = (0..graph.left.len() as u32).filter(|&left| matching.of_left[left as usize] == NOBODY);
    let mut layer: Vec<_> = unmatched.collect();
    let (mut depth, mut found) = (0, false);
    for &left in &layer {
        depths[left as usize] = 0;
    }
    while !found && !layer.is_empty() {
        depth += 1;
        let mut following = Vec::new();
        for &right in layer.iter().flat_map(|&left| &graph.left[left as usize]) {
            let partner = matching.of_right[right as usize];
            if partner == NOBODY {
                found = true;
            } else if depths[partner as usize] == NOBODY {
                depths[partner as usize] = depth;
                following.push(partner);
            }
        }
        layer = following;
    }
    found.then_some(depths)
}

/// Grows the matching along a path of rising depth from an unmatched left vertex, if there still is one. `tried`
/// counts the neighbours of each left vertex that lead nowhere or are used up.
fn augment(graph: &Graph, matching: &mut Matching, depths: &[u32], tried: &mut [usize], start: u32) {
    let mut path = vec![start];
    while let Some(&left) = path.last() {
        let Some(&right) = graph.left[left as usize].get(tried[left as usize]) else {
            path.pop();
            if let Some(&before) = path.last() {
                tried[before as usize] += 1;
            }
            continue;
        };
        let partner = matching.of_right[right as usize];
        if partner == NOBODY {
            // Each left vertex on the path now takes the right vertex that it was trying.
            for &left in &path {
                let right = graph.left[left as usize][tried[left as usize]];
                tried[left as usize] += 1;
                matching.of_left[left as usize] = right;
                matching.of_right[right as usize] = left;
            }
            return;
        }
        if depths[partner as usize] == depths[left as usize] + 1 {
            path.push(partner);
        } else {
            tried[left as usize] += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size_of_set(left: &[&[u32]], right_count: usize) -> usize {
        let graph = Graph { left: left.iter().map(|of| of.to_vec()).collect(), right_count };
        let (left_kept, right_kept) = largest_independent_set(&graph);
        for (of, _) in graph.left.iter().zip(&left_kept).filter(|&(_, &kept)| kept) {
            assert!(of.iter().all(|&right| !right_kept[right as usize]), "neighbours were kept");
        }
        left_kept.iter().chain(&right_kept).filter(|&&kept| kept).count()
    }

    #[test]
    fn nothing_meets_so_all_stay() {
        assert_eq!(size_of_set(&[&[], &[]], 3), 5);
    }

    #[test]
    fn one_that_meets_many_gives_way() {
        assert_eq!(size_of_set(&[&[0, 1, 2]], 3), 3);
    }

    #[test]
    fn a_greedy_matching_is_not_enough() {
        assert_eq!(size_of_set(&[&[0, 1], &[0], &[1, 2], &[2]], 3), 4);
    }
}
